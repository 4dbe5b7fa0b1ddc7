// SPDX-License-Identifier: MIT
// A bundle enters its members into the pass.
#include <framework/pass/bundle.h>
#include <framework/pass/pass.h>

namespace lodestir {

BundlePort::Member::Member(Pass* pass, const BundlePort& owner, const BundleMember& member, Role role_, Count count_, bool optional_)
    : Port(pass, member.name, member.doc, member.type, role_, {.count = count_}, optional_),
      inBundle(member.name),
      fullName_(std::string(owner.name) + "." + std::string(member.name)),
      fullDoc_(std::string(owner.doc) + ": " + std::string(member.doc)) {
    name = fullName_;
    doc = fullDoc_;
    bundle = &owner;
}

BundlePort::BundlePort(Pass* pass, std::string_view name_, std::string_view doc_, std::string_view type_,
                       std::span<const BundleMember> members_, Port::Role role, Count count, bool optional)
    : name(name_), doc(doc_), type(type_) {
    for (const BundleMember& member : members_) members.emplace_back(pass, *this, member, role, count, optional);
}

}  // namespace lodestir
