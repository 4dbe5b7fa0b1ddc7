// SPDX-License-Identifier: MIT
// The frame of a report: a page that needs no other file.
#pragma once
#include <string>

namespace lodestir {

/// HTML with title, a sentence about it (both plain text), and a body (HTML).
std::string pageHtml(const std::string& title, const std::string& about, const std::string& body);

}  // namespace lodestir
