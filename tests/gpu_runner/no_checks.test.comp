// SPDX-License-Identifier: MIT
// Must fail: a test that checks nothing proves nothing.
#version 460
#include "base/test.glsl"
layout(local_size_x = 1) in;
void main() {}
