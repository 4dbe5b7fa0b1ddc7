// SPDX-License-Identifier: MIT
// Small vector mathematics that every module shares.

const float PI = 3.14159265358979;
const float TWO_PI = 6.28318530717959;
const float INV_PI = 0.318309886183791;
const float FAR = 1e30;  // length of a ray without end

float square(float x) { return x * x; }

float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }

/// Rec. 709 luminance of linear RGB.
float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

bool finite3(vec3 v) { return !any(isnan(v)) && !any(isinf(v)); }

/// v as a unit vector; `otherwise` where v is zero, tiny beyond division, or not finite. The largest component is divided out first, so
/// that squares neither vanish nor overflow; the squared length is then within 1..3 unless a component is NaN.
vec3 safeNormalize(vec3 v, vec3 otherwise) {
    float size = maxComponent(abs(v));
    vec3 scaled = v * (1.0 / clamp(size, 1e-30, 1e30));
    float lengthSquared = dot(scaled, scaled);
    return lengthSquared >= 0.99 && lengthSquared <= 3.01 ? scaled * inversesqrt(lengthSquared) : otherwise;
}

/// A right-handed basis with columns t, b, n around the unit vector n, without branches and without a singular direction
/// (Duff et al. 2017, Building an Orthonormal Basis, Revisited).
mat3 basisAround(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}
