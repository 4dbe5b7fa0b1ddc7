// SPDX-License-Identifier: MIT
// Parameters enter themselves into their pass, and say in words what they accept.
#include <framework/pass/parameter.h>
#include <framework/pass/pass.h>

#include <fmt/format.h>

namespace lodestir {

Parameter::Parameter(Pass* pass, std::string_view name_, std::string_view doc_, Value initial_, Value low_, Value high_, bool constant_,
                     std::vector<std::string_view> choices_)
    : name(name_),
      doc(doc_),
      value(initial_),
      initial(initial_),
      low(std::move(low_)),
      high(std::move(high_)),
      choices(std::move(choices_)),
      constant(constant_) {
    pass->parameters.push_back(this);
}

std::string Parameter::typeText() const {
    if (isChoice()) return fmt::format("{}", fmt::join(choices, " | "));
    if (std::holds_alternative<bool>(initial)) return "bool";
    if (std::holds_alternative<int>(initial)) return fmt::format("int {}..{}", std::get<int>(low), std::get<int>(high));
    if (std::holds_alternative<float>(initial)) return fmt::format("float {}..{}", std::get<float>(low), std::get<float>(high));
    return isFile ? "file" : "text";
}

}  // namespace lodestir
