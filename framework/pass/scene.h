// SPDX-License-Identifier: MIT
// For passes that read the scene on the CPU: as it was loaded, which levels its own policy shows or others force, and how it lies on the device.
#pragma once
#include <framework/scene/forced_levels.h>
#include <framework/scene/level_policy.h>
#include <framework/scene/records.h>
#include <framework/scene/scene.h>
