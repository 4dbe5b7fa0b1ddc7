// SPDX-License-Identifier: MIT
// Pieces of a kitchen. What stands, stands on y = 0; cabinets and appliances have their back at z = 0 and face +z, their left at x = 0.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "glb.h"

namespace lodestir::generate {

/// Materials of a kitchen, as indices.
struct KitchenPaints {
    int front, carcass, counter;  ///< of cabinets: painted doors, what is dark behind and below them, the stone above
    int chrome, steel, black, leather;
};

/// What a cabinet shows.
enum class Fronts { doors, drawers, oven };

/// A base cabinet 0.6 m deep and 0.9 m high with its counter; its fronts are framed panels with bar grips.
Model baseCabinet(const std::string& name, const KitchenPaints& paints, float width, Fronts fronts);

/// A bar stool: trumpet foot, column and foot ring of metal, a padded seat at 0.66 m.
Model barStool(const std::string& name, const KitchenPaints& paints);

/// A saucepan with lid and handles, of `radius`.
Model saucepan(const std::string& name, const KitchenPaints& paints, float radius);

/// A tall round bin with a domed lid.
Model bin(const std::string& name, const KitchenPaints& paints, float radius, float height);

}  // namespace lodestir::generate
