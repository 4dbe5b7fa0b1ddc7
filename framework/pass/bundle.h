// SPDX-License-Identifier: MIT
// What always travels together is wired as one: a bundle of buffers, which the family that owns them declares once:
//
//     struct Paths {
//         static constexpr std::string_view name = "Paths";
//         static constexpr std::array members{bundled<Reservoir>("reservoirs", "the path with its weight"),
//                                             bundled<SampleHit>("samples", "where it begins")};
//     };
//
// and passes name like any type of port: In<Paths> paths{this, "paths", "this frame's path of each pixel"}. A graph wires "paths". Each member is a port
// of its own to shaders, which read pathsReservoirs(i), and to whoever shows or dumps it, as "initial.paths.reservoirs".
#pragma once
#include <framework/pass/port.h>

#include <array>
#include <concepts>
#include <deque>
#include <span>

namespace lodestir {

/// A buffer of a bundle.
struct BundleMember {
    std::string_view name, doc;
    PortType type;
};
/// A member that is an array of the shared struct T.
template <class T> constexpr BundleMember bundled(std::string_view name, std::string_view doc) { return {name, doc, PortTypeOf<Buffer<T>>::value}; }

/// A struct that tells its name and what it is made of.
template <class B>
concept Bundle = requires {
    { B::name } -> std::convertible_to<std::string_view>;
    { std::span(B::members) } -> std::convertible_to<std::span<const BundleMember>>;
    requires std::size(B::members) > 0;
};

/// A bundle as a pass declares it: enters a port for each member into the pass's list, one after the other.
class LODESTIR_API BundlePort {
public:
    class Member : public Port {
    public:
        Member(Pass* pass, const BundlePort& bundle, const BundleMember& member, Role role, Count count, bool optional);
        const std::string_view inBundle;  ///< the name without the bundle's: "reservoirs"

    private:
        const std::string fullName_, fullDoc_;
    };
    const std::string_view name, doc;
    const std::string_view type;  ///< the bundle's own name: "Paths"
    std::deque<Member> members;   // never moved: the pass's list points into it

    BundlePort(const BundlePort&) = delete;
    BundlePort& operator=(const BundlePort&) = delete;

protected:
    BundlePort(Pass* pass, std::string_view name, std::string_view doc, std::string_view type, std::span<const BundleMember> members,
               Port::Role role, Count count, bool optional = false);
};

template <Bundle B> struct In<B> : BundlePort {
    In(Pass* pass, std::string_view n, std::string_view d, Need need = Need::required)
        : BundlePort(pass, n, d, B::name, B::members, Port::Role::in, {}, need == Need::optional) {}
};
template <Bundle B> struct Out<B> : BundlePort {
    Out(Pass* pass, std::string_view n, std::string_view d, Count c) : BundlePort(pass, n, d, B::name, B::members, Port::Role::out, c) {}
};
template <Bundle B> struct State<B> : BundlePort {
    State(Pass* pass, std::string_view n, std::string_view d, Count c) : BundlePort(pass, n, d, B::name, B::members, Port::Role::state, c) {}
};
template <Bundle B> struct Scratch<B> : BundlePort {
    Scratch(Pass* pass, std::string_view n, std::string_view d, Count c) : BundlePort(pass, n, d, B::name, B::members, Port::Role::scratch, c) {}
};

}  // namespace lodestir
