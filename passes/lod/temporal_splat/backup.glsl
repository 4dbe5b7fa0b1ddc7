// SPDX-License-Identifier: MIT
// Which share of the history reprojection brings. After pass.glsl.

/// Splatting keeps the first hit and moves the path's place on the film, so it needs that place to be a dimension of the path. Where it is the pixel's,
/// no path of last frame has its first hit where the pixel looks, and all of the history is reprojected.
float backupShare() { return rules().pixelCamera != 0 ? 1 : params.backup; }
