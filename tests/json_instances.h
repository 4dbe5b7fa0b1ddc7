// SPDX-License-Identifier: MIT
// What all tests use of the JSON library, compiled once (json_instances.cpp) in place of once a test: a quarter of the time that they take to build.
#pragma once
#include <nlohmann/json.hpp>

extern template class nlohmann::basic_json<nlohmann::ordered_map>;
extern template class nlohmann::detail::serializer<nlohmann::ordered_json>;
extern template class nlohmann::detail::json_sax_dom_parser<nlohmann::ordered_json>;
