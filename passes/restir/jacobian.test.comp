// SPDX-License-Identifier: MIT
// If these fail, shifted paths weigh as if they covered more or less of path space than they do: corners and glossy surfaces are biased.
// groups: 16
#version 460
#include "base/random.glsl"
#include "base/test.glsl"
#include "restir/jacobian.glsl"
layout(local_size_x = 64) in;

// Derivatives are central differences of this step. Error by rounding: 1e-7 / 1e-2 of the coordinates; by the step: its square.
const float STEP = 1e-2;

// A lobe cos^n around an axis, which can be inverted: its density per solid angle, the direction of u, and u of a direction.
struct Lobe { vec3 axis; float n; };
float lobePdf(Lobe l, vec3 d) { return (l.n + 1.0) / TWO_PI * pow(max(dot(l.axis, d), 1e-6), l.n); }
vec3 lobeSample(Lobe l, vec2 u) {
    float z = pow(u.x, 1.0 / (l.n + 1.0));
    return basisAround(l.axis) * vec3(sqrt(1.0 - z * z) * vec2(cos(TWO_PI * u.y), sin(TWO_PI * u.y)), z);
}
vec2 lobeInverse(Lobe l, vec3 d) {
    vec3 local = d * basisAround(l.axis);
    float phi = atan(local.y, local.x) / TWO_PI;
    return vec2(pow(local.z, l.n + 1.0), phi - floor(phi));
}

// Two paths that meet in a plane z = 2 above their vertices x_{k-1}, y_{k-1}, and go on in one direction.
struct Scene { vec3 x, y, normal; Lobe lobeX, lobeY; float nAt; };
Scene someScene(uint id) {
    vec3 a = random3(uvec2(id, 9), 0u, 0u), b = random3(uvec2(id, 9), 1u, 0u), c = random3(uvec2(id, 9), 2u, 0u);
    vec3 normal = normalize(vec3(0.6 * b.xy - 0.3, -1.0));
    Lobe lobeX = Lobe(normalize(vec3(0.2 * c.xy, 1.0)), 1.0 + c.z), lobeY = Lobe(normalize(vec3(-0.3 * a.xy, 1.0)), 1.0 + 2.0 * a.z);
    return Scene(vec3(0.4 * a.xy - 0.2, 0.5 * a.z), vec3(0.8 + 0.4 * b.z, 0.5 * c.xy), normal, lobeX, lobeY, 2.0 + b.x);
}
vec3 meet(Scene s, vec2 u) {  // x_k from random numbers at x_{k-1}
    vec3 d = lobeSample(s.lobeX, u);
    return s.x + d * (dot(s.normal, vec3(0, 0, 2) - s.x) / dot(s.normal, d));
}
Lobe lobeAt(Scene s, vec3 from, vec3 xk) { return Lobe(reflect(normalize(xk - from), s.normal), s.nAt); }

// The shift in primary sample space: (u_{k-1}, u_k) of the base path to those of the shifted path.
vec4 shift(Scene s, vec4 u) {
    vec3 xk = meet(s, u.xy), away = lobeSample(lobeAt(s, s.x, xk), u.zw);
    return vec4(lobeInverse(s.lobeY, normalize(xk - s.y)), lobeInverse(lobeAt(s, s.y, xk), away));
}
vec4 turn(vec4 difference) { return vec4(difference.x, fract(difference.y + 0.5) - 0.5, difference.z, fract(difference.w + 0.5) - 0.5); }

void testReconnection(Scene s, vec2 u) {
    vec3 xk = meet(s, u);
    mat3 plane = basisAround(s.normal);
    // Solid angles of one small parallelogram at x_k, seen from both sides.
    float h = STEP;
    vec3 tx = (normalize(xk + plane[0] * h - s.x) - normalize(xk - plane[0] * h - s.x)) / (2.0 * h);
    vec3 bx = (normalize(xk + plane[1] * h - s.x) - normalize(xk - plane[1] * h - s.x)) / (2.0 * h);
    vec3 ty = (normalize(xk + plane[0] * h - s.y) - normalize(xk - plane[0] * h - s.y)) / (2.0 * h);
    vec3 by = (normalize(xk + plane[1] * h - s.y) - normalize(xk - plane[1] * h - s.y)) / (2.0 * h);
    float Gx = geometryTerm(s.x, xk, s.normal), Gy = geometryTerm(s.y, xk, s.normal);
    EXPECT_NEAR(length(cross(tx, bx)) / Gx, 1.0, 1e-3);
    EXPECT_NEAR(length(cross(ty, by)) / length(cross(tx, bx)) / reconnectionJacobian(Gy, Gx), 1.0, 2e-3);
    EXPECT_NEAR(reconnectionJacobian(Gy, Gx) * reconnectionJacobian(Gx, Gy), 1.0, 1e-6);  // there and back
}

void testHybrid(Scene s, vec4 u) {
    vec3 xk = meet(s, u.xy), toX = normalize(xk - s.x), toY = normalize(xk - s.y);
    Lobe atX = lobeAt(s, s.x, xk), atY = lobeAt(s, s.y, xk);
    vec3 away = lobeSample(atX, u.zw);
    // Away from where the lobe's own coordinates are singular.
    vec4 v = shift(s, u);
    if (dot(atY.axis, away) < 0.2 || any(lessThan(v.xz, vec2(0.1))) || any(greaterThan(v.xz, vec2(0.9)))) return;
    float h = 0.3 * STEP;
    mat4 derivative;
    for (int i = 0; i < 4; ++i) {
        vec4 e = vec4(0.0);
        e[i] = h;
        derivative[i] = turn(shift(s, u + e) - shift(s, u - e)) / (2.0 * h);
    }
    float Gx = geometryTerm(s.x, xk, s.normal), Gy = geometryTerm(s.y, xk, s.normal);
    ReconnectionTerms x = reconnectionTerms(RC_SURFACE, lobePdf(s.lobeX, toX), Gx, lobePdf(atX, away));
    ReconnectionTerms y = reconnectionTerms(RC_SURFACE, lobePdf(s.lobeY, toY), Gy, lobePdf(atY, away));
    float jacobian = hybridJacobian(y, x);
    EXPECT_NEAR(abs(determinant(derivative)) / jacobian, 1.0, 1e-2);
    // Without the last direction: a path that ends at x_k.
    mat2 block = mat2(derivative[0].xy, derivative[1].xy);
    ReconnectionTerms lightX = reconnectionTerms(RC_EMITTER, x.pBefore, Gx, 7.0);
    ReconnectionTerms lightY = reconnectionTerms(RC_EMITTER, y.pBefore, Gy, 9.0);
    EXPECT_NEAR(abs(determinant(block)) / hybridJacobian(lightY, lightX), 1.0, 1e-2);
    EXPECT_NEAR(hybridJacobian(y, x) * hybridJacobian(x, y), 1.0, 1e-5);
    // From solid angle, density by density; and both forms estimate the same: F = I / (p_{k-1} p_k).
    float step = primarySampleJacobian(reconnectionJacobian(Gy, Gx), y.pBefore, x.pBefore);
    EXPECT_NEAR(primarySampleJacobian(step, y.pAt, x.pAt) / jacobian, 1.0, 1e-5);
    float ratio = reconnectionJacobian(Gy, Gx);  // of F J in the mixed measure, where F is the same for both
    EXPECT_NEAR(x.pBefore * x.pAt / (y.pBefore * y.pAt) * jacobian / ratio, 1.0, 1e-5);
    EXPECT_NEAR(x.pBefore / y.pBefore * hybridJacobian(lightY, lightX) / ratio, 1.0, 1e-5);
    // A light's point, of density 0.3 and 0.7 per area: per solid angle 0.3 / G and 0.7 / G.
    float light = hybridJacobian(reconnectionTerms(RC_LIGHT, 0.7, Gy, 1.0), reconnectionTerms(RC_LIGHT, 0.3, Gx, 1.0));
    EXPECT_NEAR((0.3 / Gx) / (0.7 / Gy) * light / ratio, 1.0, 1e-5);
}

// The same numbers in another lobe: solid angles against replayJacobian.
void testReplay(Scene s, vec2 u) {
    float h = 0.3 * STEP;
    vec3 x = lobeSample(s.lobeX, u), y = lobeSample(s.lobeY, u);
    vec3 xu = lobeSample(s.lobeX, u + vec2(h, 0)) - lobeSample(s.lobeX, u - vec2(h, 0));
    vec3 xv = lobeSample(s.lobeX, u + vec2(0, h)) - lobeSample(s.lobeX, u - vec2(0, h));
    vec3 yu = lobeSample(s.lobeY, u + vec2(h, 0)) - lobeSample(s.lobeY, u - vec2(h, 0));
    vec3 yv = lobeSample(s.lobeY, u + vec2(0, h)) - lobeSample(s.lobeY, u - vec2(0, h));
    float px = lobePdf(s.lobeX, x), py = lobePdf(s.lobeY, y), jacobian = replayJacobian(py, px);
    EXPECT_NEAR(length(cross(yu, yv)) / length(cross(xu, xv)) / jacobian, 1.0, 2e-3);
    EXPECT_NEAR(primarySampleJacobian(jacobian, py, px), 1.0, 1e-6);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    Scene s = someScene(id);
    vec4 u = vec4(random2(uvec2(id, 10), 0u, 0u), random2(uvec2(id, 10), 1u, 0u)) * 0.4 + 0.3;
    testReconnection(s, u.xy);
    testHybrid(s, u);
    testReplay(s, u.xy);
    if (id > 0u) return;
    // Known answers: 2 above a floor seen at 60 degrees; kinds; failure.
    EXPECT_NEAR(geometryTerm(vec3(0, 0, 2), vec3(0), vec3(0, 0, 1)), 0.25, 1e-7);
    EXPECT_NEAR(geometryTerm(vec3(sqrt(3.0), 0, 1), vec3(0), vec3(0, 0, -1)), 0.125, 1e-7);
    EXPECT_EQ(geometryTerm(vec3(1), vec3(1), vec3(0, 0, 1)), 0.0);
    EXPECT_EQ(reconnectionJacobian(0.0, 1.0), 0.0);
    EXPECT_EQ(reconnectionJacobian(1.0, 0.0), 0.0);
    EXPECT_EQ(reconnectionJacobian(1e30, 1e-30), 0.0);
    ReconnectionTerms x = ReconnectionTerms(2.0, 4.0, 8.0), y = ReconnectionTerms(3.0, 5.0, 7.0);
    float expected[6] = float[](1.0, 105.0 / 64.0, 15.0 / 8.0, 15.0 / 8.0, 1.5, 1.5);  // by RC_*
    for (uint kind = RC_NONE; kind <= RC_LIGHT; ++kind) {
        ReconnectionTerms of = reconnectionTerms(kind, x.pBefore, x.G, x.pAt);
        EXPECT_NEAR(hybridJacobian(reconnectionTerms(kind, y.pBefore, y.G, y.pAt), of), expected[kind], 1e-6);
    }
    EXPECT_EQ(hybridJacobian(reconnectionTerms(RC_SURFACE, 1.0, 1.0, 0.0), x), 0.0);
    EXPECT_NEAR(hybridJacobian(ReconnectionTerms(1e20, 1e-20, 1e20), ReconnectionTerms(2e20, 1e-20, 1e20)), 0.5, 1e-6);
}
