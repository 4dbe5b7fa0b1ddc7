// SPDX-License-Identifier: MIT
// Must fail: the message names this file and the line of the mistake, below an include.
#version 460
#include "base/test.glsl"
layout(local_size_x = 1) in;
void main() {
    EXPECT_TRUE(undeclared);
}
