// SPDX-License-Identifier: MIT
// Marks what a plugin or an executable may use of the framework's shared library; everything else stays hidden.
#pragma once

#define LODESTIR_API __attribute__((visibility("default")))
