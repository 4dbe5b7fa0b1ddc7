// SPDX-License-Identifier: MIT
// For passes that read or write image files.
#pragma once
#include <framework/image/image_file.h>
