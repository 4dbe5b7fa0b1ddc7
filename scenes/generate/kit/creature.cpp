// SPDX-License-Identifier: MIT
// A plated beast: see creature.h. Its bones are a table: each says where clay goes, and what covers it.
#include "creature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "atlas.h"
#include "figure.h"
#include "noise.h"
#include "random.h"
#include "sculpture.h"
#include "spline.h"

namespace lodestir::generate {

namespace {

constexpr int pictureTexels = 2048;
constexpr float hornStrip = 0.06f;  ///< of the picture's height
constexpr float pi = std::numbers::pi_v<float>;
constexpr glm::vec3 eye(0.305f, 1.064f, 0.096f);

struct Bone {
    std::vector<Station> axis;
    float blend;       ///< metres over which its clay runs into what is there
    glm::vec3 dorsal;  ///< the side on which plates lie
    int columns;       ///< of plates, if they went all around
    float reach;       ///< radians from the dorsal side, up to where there are plates

    std::vector<float> rows{};  ///< of plates from the axis's start to each of its points; they are as long as the bone is wide
    glm::vec3 middle{0};        ///< of a sphere around it
    float radius = 0;
};

/// What a place is to the bone that is nearest.
struct Place {
    const Bone* bone = nullptr;
    float gap = 1e3f;     ///< metres outside the bone
    float row = 0;        ///< rows of plates from the axis's start
    float around = 0;     ///< radians from the dorsal side
    float plate = 0;      ///< metres of a row
    float margin = 1e3f;  ///< metres by which the next bone is farther; more than farMargin: whatever
};

constexpr float farMargin = 0.05f;  ///< metres: bones that are farther than the nearest by more don't count

constexpr float slenderness = 0.88f;  ///< length of a row over the width of its plates
float rowLength(const Bone& bone, float radius) { return std::max(slenderness * 2 * pi * radius / float(bone.columns), 0.014f); }

/// One arm is raised: its elbow by so many metres.
float liftOf(float side) { return side > 0 ? 0.07f : 0; }

std::vector<Bone> skeleton() {
    std::vector<Bone> bones;
    bones.push_back({{{{0.125f, 0.945f, 0}, 0.100f},
                      {{0.070f, 0.810f, 0}, 0.158f},
                      {{0.010f, 0.640f, 0}, 0.208f},
                      {{-0.040f, 0.470f, 0}, 0.215f},
                      {{-0.140f, 0.325f, 0}, 0.172f},
                      {{-0.310f, 0.195f, 0}, 0.112f},
                      {{-0.500f, 0.105f, 0.010f}, 0.076f},
                      {{-0.680f, 0.064f, 0.050f}, 0.053f},
                      {{-0.840f, 0.058f, 0.125f}, 0.036f},
                      {{-0.955f, 0.085f, 0.205f}, 0.018f}},
                     0.05f,
                     {-0.7f, 0.7f, 0},
                     14,
                     2.05f});
    bones.push_back({{{{0.115f, 0.950f, 0}, 0.098f},
                      {{0.200f, 1.035f, 0}, 0.108f},
                      {{0.300f, 1.010f, 0}, 0.088f},
                      {{0.400f, 0.962f, 0}, 0.061f},
                      {{0.480f, 0.922f, 0}, 0.042f}},
                     0.07f,
                     {0, 1, 0},
                     12,
                     1.45f});
    for (float side : {-1.0f, 1.0f}) {
        const auto at = [&](float x, float y, float z) { return glm::vec3(x, y, side * z); };
        const float lift = liftOf(side);
        bones.push_back({{{at(0.085f, 0.805f, 0.115f), 0.086f},
                          {at(0.115f, 0.715f, 0.225f), 0.077f},
                          {at(0.150f, 0.590f + lift, 0.280f), 0.061f},
                          {at(0.250f, 0.565f + 1.5f * lift, 0.270f), 0.052f},
                          {at(0.345f, 0.590f + 2.3f * lift, 0.240f), 0.046f},
                          {at(0.385f, 0.600f + 2.5f * lift, 0.228f), 0.047f}},
                         0.05f,
                         at(-0.45f, 0.35f, 0.80f),
                         8,
                         2.0f});
        bones.push_back({{{at(-0.035f, 0.400f, 0.115f), 0.152f},
                          {at(0.080f, 0.275f, 0.205f), 0.116f},
                          {at(0.045f, 0.165f, 0.215f), 0.082f},
                          {at(0.000f, 0.092f, 0.207f), 0.064f},
                          {at(0.075f, 0.052f, 0.217f), 0.055f},
                          {at(0.150f, 0.044f, 0.228f), 0.045f}},
                         0.05f,
                         at(0.62f, 0.40f, 0.62f),
                         9,
                         2.1f});
    }
    for (Bone& bone : bones) {
        bone.axis = spline(bone.axis, 3);
        for (const Station& s : bone.axis) bone.middle += s.position / float(bone.axis.size());
        for (const Station& s : bone.axis) bone.radius = std::max(bone.radius, glm::distance(s.position, bone.middle) + s.radius);
        float rows = 0;
        for (size_t i = 0; i < bone.axis.size(); ++i) {
            if (i > 0) rows += glm::distance(bone.axis[i].position, bone.axis[i - 1].position) / rowLength(bone, bone.axis[i].radius);
            bone.rows.push_back(rows);
        }
    }
    return bones;
}

/// Claws and horns, from root to tip.
std::vector<std::vector<Station>> hornAxes() {
    std::vector<std::vector<Station>> horns{
        {{{0.425f, 0.975f, 0}, 0.030f}, {{0.455f, 1.035f, 0}, 0.024f}, {{0.474f, 1.090f, 0}, 0.014f}, {{0.476f, 1.135f, 0}, 0.004f}}};
    const auto claw = [&](const glm::vec3& root, const glm::vec3& middle, const glm::vec3& tip, float radius) {
        horns.push_back(
            {{root, 0.8f * radius}, {middle, radius}, {glm::mix(middle, tip, 0.6f) + glm::vec3(0, 0.004f, 0), 0.7f * radius}, {tip, 0.15f * radius}});
    };
    for (float side : {-1.0f, 1.0f}) {
        const auto at = [&](float x, float y, float z) { return glm::vec3(x, y, side * z); };
        const glm::vec3 palm = at(0.400f, 0.600f + 2.5f * liftOf(side), 0.225f);
        for (float f : {-1.0f, 0.0f, 1.0f}) {
            claw(palm + at(0, 0.026f * f, 0.010f - 0.008f * f), palm + at(0.060f, 0.040f * f + 0.006f, 0.006f - 0.015f * f),
                 palm + at(0.138f, 0.047f * f - 0.024f, -0.008f - 0.020f * f), 0.0190f);
            claw(at(0.150f, 0.040f, 0.228f + 0.028f * f), at(0.205f, 0.040f, 0.232f + 0.041f * f), at(0.280f, 0.004f, 0.236f + 0.050f * f), 0.0210f);
        }
        horns.push_back({{at(0.255f, 1.070f, 0.040f), 0.031f},
                         {at(0.265f, 1.150f, 0.062f), 0.025f},
                         {at(0.235f, 1.225f, 0.080f), 0.017f},
                         {at(0.170f, 1.280f, 0.090f), 0.004f}});
    }
    return horns;
}

const std::vector<Bone> bones = skeleton();
const std::vector<std::vector<Station>> horns = hornAxes();

/// Metres from a chain of round cones; where along it, as a span and a share of that.
struct Nearest {
    float gap = 1e3f, share = 0;
    size_t span = 0;
};
Nearest nearestOn(const std::vector<Station>& axis, const glm::vec3& p) {
    Nearest found;
    for (size_t i = 0; i + 1 < axis.size(); ++i) {
        const Station &a = axis[i], &b = axis[i + 1];
        const glm::vec3 e = b.position - a.position;
        const float share = std::clamp(glm::dot(p - a.position, e) / glm::dot(e, e), 0.0f, 1.0f);
        const float gap = glm::distance(p, a.position + share * e) - glm::mix(a.radius, b.radius, share);
        if (gap < found.gap) found = {gap, share, i};
    }
    return found;
}

bool isHorn(const glm::vec3& p) {
    return std::ranges::any_of(horns, [&](const auto& axis) {
        return glm::distance(p, axis[1].position) < 0.16f && nearestOn(axis, p).gap < 0.003f;  // none is longer
    });
}

Place placeOf(const glm::vec3& p) {
    Place best;
    Nearest nearest;
    for (const Bone& bone : bones) {
        if (glm::distance(p, bone.middle) - bone.radius > best.gap + farMargin) continue;
        const Nearest found = nearestOn(bone.axis, p);
        best.margin = found.gap < best.gap ? best.gap - found.gap : std::min(best.margin, found.gap - best.gap);
        if (found.gap < best.gap) best.gap = found.gap, best.bone = &bone, nearest = found;
    }
    const std::vector<Station>& axis = best.bone->axis;
    const size_t i = nearest.span;
    // From span to span the axis turns smoothly, or rows would break.
    const auto direction = [&](size_t k) { return glm::normalize(axis[std::min(k + 1, axis.size() - 1)].position - axis[k > 0 ? k - 1 : 0].position); };
    const glm::vec3 along = glm::normalize(glm::mix(direction(i), direction(i + 1), nearest.share));
    const glm::vec3 up = glm::normalize(best.bone->dorsal - along * glm::dot(along, best.bone->dorsal)), right = glm::cross(along, up);
    const glm::vec3 away = p - glm::mix(axis[i].position, axis[i + 1].position, nearest.share);
    best.around = std::atan2(glm::dot(away, right), glm::dot(away, up));
    best.row = glm::mix(best.bone->rows[i], best.bone->rows[i + 1], nearest.share);
    best.plate = rowLength(*best.bone, glm::mix(axis[i].radius, axis[i + 1].radius, nearest.share));
    return best;
}

/// The plate that lies uppermost at a place. Rows overlap as tiles do, half a plate aside from row to row.
struct Plate {
    bool isThere = false;
    float along = 0, aside = 0;  ///< from its root, in rows, up to `length` in its middle; from its middle, [-0.5, 0.5]
    float edge = 0;              ///< how far inside its outline, in rows
    float worn = 0;              ///< [0, 1]: how old it looks
    uint32_t id = 0;

    static constexpr float length = 1.6f, curve = 2.4f;  ///< the outline: along < length - curve * aside^2
};

Plate plateAt(const Place& place) {
    const Bone& bone = *place.bone;
    const float turns = place.around / (2 * pi) * float(bone.columns);
    const int row = int(std::floor(place.row));
    for (int r : {row - 1, row}) {
        Plate plate;
        const float shift = r & 1 ? 0.5f : 0;
        const float column = std::round(turns - shift);
        plate.along = place.row - float(r);
        plate.aside = turns - shift - column;
        plate.edge = Plate::length - Plate::curve * plate.aside * plate.aside - plate.along;
        if (plate.edge <= 0) continue;
        const float gap = 0.5f - std::abs(plate.aside);  // to the neighbour of its row, where the row before leaves it open
        plate.edge = std::min(plate.edge, 1.3f * gap);
        plate.isThere = std::abs(column + shift) / float(bone.columns) * 2 * pi < bone.reach;
        plate.id = hash(uint32_t(&bone - bones.data()), uint32_t(r + 1000), uint32_t(int(column) + 1000));
        plate.worn = unit(plate.id);
        return plate;
    }
    return {};
}

bool isEar(const glm::vec3& p, const Place& place) { return p.y > 1.07f && p.x < 0.24f && place.gap > 0.030f; }

/// What stands up from the clay and is large enough to be shape, metres.
float relief(const glm::vec3& p, const Place& place) {
    // Where two bones meet plates would collide: skin is between them.
    const float room = glm::smoothstep(0.004f, 0.030f, place.margin),
                inEye = glm::smoothstep(0.020f, 0.034f, glm::distance(glm::vec3(p.x, p.y, std::abs(p.z)), eye));
    const Plate plate = plateAt(place);
    const Noise noise{91};
    if (!plate.isThere || isEar(p, place)) return -0.0035f * inEye * noise.ridged(p * glm::vec3(9, 24, 9), 2);
    const float tall = std::min(0.24f * place.plate, 0.0150f);
    const float keel = std::max(1 - std::abs(plate.aside) * 5, 0.0f);
    const float face = 0.22f + 0.78f * plate.along / Plate::length + 0.16f * keel + 0.08f * (plate.worn - 0.5f);
    return tall * room * inEye * face * glm::smoothstep(0.0f, 0.20f, plate.edge);
}

void addEars(Sculpture& clay) {
    for (float side : {-1.0f, 1.0f}) {
        const glm::vec3 along = glm::normalize(glm::vec3(-0.50f, 0.62f, side * 0.62f)), front = glm::normalize(glm::vec3(0.75f, 0.35f, side * 0.25f));
        const glm::vec3 across = glm::normalize(glm::cross(along, front)), out = glm::cross(across, along);
        const glm::vec3 middle = glm::vec3(0.165f, 1.075f, side * 0.075f) + 0.130f * along;
        clay.blend = 0.030f;
        clay.lump(middle, glm::mat3(0.150f * along, 0.062f * across, 0.030f * out));
        clay.blend = 0.020f;
        clay.hollow(middle + 0.034f * out + 0.012f * along, glm::mat3(0.118f * along, 0.043f * across, 0.030f * out));
    }
}

Sculpture modelled() {
    Sculpture clay;
    for (const Bone& bone : bones) {
        clay.blend = bone.blend;
        clay.limb(bone.axis);
    }
    clay.blend = 0.12f;
    clay.lump({0.065f, 0.54f, 0}, glm::mat3(glm::vec3(0.170f, 0.02f, 0), glm::vec3(0, 0.200f, 0), glm::vec3(0, 0, 0.185f)));  // paunch
    addEars(clay);
    for (float side : {-1.0f, 1.0f}) {
        const glm::vec3 at = eye * glm::vec3(1, 1, side);
        clay.blend = 0.020f;
        clay.lump(at + glm::vec3(0.006f, 0.022f, side * 0.002f),
                  glm::mat3(glm::vec3(0.036f, -0.010f, 0), glm::vec3(0.003f, 0.013f, 0), glm::vec3(0, 0, 0.020f)));
        clay.blend = 0.004f;
        clay.lump(at, glm::mat3(0.0205f));
    }
    return clay;
}

Surface hornAt(const glm::vec3& p, const Noise& noise) {
    const bool isClaw = p.y < 0.86f;
    const float rings = noise.ridged(p * (isClaw ? glm::vec3(20, 90, 90) : glm::vec3(30, 120, 30)), 2);
    Surface s;
    s.color = isClaw ? glm::mix(glm::vec3(0.035f, 0.028f, 0.024f), glm::vec3(0.15f, 0.12f, 0.09f), rings)
                     : glm::mix(glm::vec3(0.16f, 0.10f, 0.06f), glm::vec3(0.62f, 0.54f, 0.40f), glm::smoothstep(1.06f, 1.26f, p.y + (p.x > 0.4f ? 0.13f : 0)));
    s.color *= 0.8f + 0.3f * rings;
    s.roughness = 0.34f;
    s.height = 0.0007f * rings;
    return s;
}

Surface skinAt(const glm::vec3& p, const glm::vec3& n, const Noise& noise) {
    const float folds = noise.ridged(p * glm::vec3(9, 24, 9), 2), pores = noise.fractal(p * 190.0f, 2, 0.7f), hue = noise.fractal(p * 4.0f, 3);
    const float head = glm::smoothstep(0.36f, 0.37f, p.x) * glm::smoothstep(0.84f, 0.86f, p.y);
    Surface s;
    s.color = glm::mix(glm::vec3(0.40f, 0.265f, 0.175f), glm::vec3(0.17f, 0.092f, 0.058f), glm::smoothstep(0.25f, 0.9f, folds));
    s.color = glm::mix(s.color, glm::vec3(0.20f, 0.115f, 0.078f), glm::smoothstep(0.95f, 1.10f, p.y));  // ears and the top of the head are darker,
    const float inside = glm::smoothstep(1.10f, 1.15f, p.y) * glm::smoothstep(0.35f, 0.7f, n.x);
    s.color = glm::mix(s.color, glm::vec3(0.42f, 0.19f, 0.14f), 0.85f * inside);  // the ears' inside is not
    s.color = glm::mix(s.color, glm::vec3(0.055f, 0.038f, 0.032f), head * glm::smoothstep(0.475f, 0.515f, p.x) * glm::smoothstep(0.97f, 0.95f, p.y));
    s.color *= (1 + 0.15f * hue) * (1 + 0.14f * pores);
    s.roughness = 0.62f + 0.12f * pores;
    s.height = 0.00055f * pores;
    // Mouth and nostrils are painted: pressed into the clay they would be charts of a few triangles, which no coarse level could keep.
    const float lips = std::abs(p.y - 0.884f + 0.34f * (p.x - 0.455f)) + 0.002f * hue,
                nostril = glm::distance(glm::vec3(p.x, p.y, std::abs(p.z)), {0.517f, 0.928f, 0.019f});
    const float deep = std::max(glm::smoothstep(0.0075f, 0.0025f, lips) * glm::smoothstep(0.365f, 0.385f, p.x), glm::smoothstep(0.0105f, 0.006f, nostril));
    s.color = glm::mix(s.color, glm::vec3(0.012f, 0.008f, 0.007f), head * deep);
    s.height -= 0.004f * head * deep;
    return s;
}

/// Plates: dark at their roots, polished and pale where they rub, streaked along.
Surface plateSurface(const glm::vec3& p, const Plate& plate, const Noise& noise) {
    const float streak = noise.fractal(glm::vec3(plate.aside * 26, plate.along * 2.5f, float(plate.id % 977)), 3, 0.6f);
    const float growth = noise.fractal(glm::vec3((plate.along + Plate::curve * plate.aside * plate.aside) * 13, float(plate.id % 613), 0.5f), 2);
    const float tip = glm::smoothstep(0.55f, 0.06f, plate.edge), hue = noise.fractal(p * 3.0f, 3);
    Surface s;
    const glm::vec3 umber(0.050f, 0.026f, 0.016f), bronze(0.185f, 0.092f, 0.040f), straw(0.44f, 0.28f, 0.135f);
    s.color = glm::mix(umber, bronze, glm::clamp(0.35f + 0.55f * plate.worn + 0.5f * hue, 0.0f, 1.0f));
    s.color = glm::mix(s.color, straw, glm::clamp(0.62f * tip + 0.22f * streak, 0.0f, 1.0f));
    s.color *= glm::mix(0.30f, 1.0f, glm::smoothstep(0.0f, 0.09f, plate.edge)) * (1 + 0.22f * streak + 0.10f * growth);
    s.roughness = 0.42f - 0.12f * tip + 0.10f * streak;
    s.height = 0.0007f * streak + 0.0006f * growth + 0.0012f * glm::smoothstep(0.0f, 0.08f, plate.edge);
    return s;
}

Surface coat(const glm::vec3& p, const glm::vec3& n) {
    const Noise noise{91};
    Surface s;
    const float toEye = glm::distance(glm::vec3(p.x, p.y, std::abs(p.z)), eye);
    const Place place = placeOf(p);
    const Plate plate = plateAt(place);
    if (toEye < 0.0225f) {
        s.color = glm::mix(glm::vec3(0.010f, 0.008f, 0.006f), glm::vec3(0.30f, 0.13f, 0.02f),
                           glm::smoothstep(0.012f, 0.016f, glm::length(glm::vec2(p.x - eye.x - 0.004f, p.y - eye.y))));
        s.roughness = 0.06f;
    } else if (isHorn(p)) {
        s = hornAt(p, noise);
    } else {
        s = plate.isThere && place.margin > 0.008f && !isEar(p, place) ? plateSurface(p, plate, noise) : skinAt(p, n, noise);
    }
    return s;
}

}  // namespace

Model creature(Glb& glb, const std::string& name, float cell) {
    // Charts are cut of the smooth body: of plates they would be thousands.
    Mesh mesh = charted(modelled().mesh(cell), pictureTexels, 250);
    for (Vertex& v : mesh.vertices) v.position += relief(v.position, placeOf(v.position)) * v.normal;
    scaleUv(mesh, {1, 1 - hornStrip});
    // Each horn is one chart, in a row below the body's.
    const float wide = 1.0f / float(horns.size());
    for (size_t i = 0; i < horns.size(); ++i) {
        Mesh horn = limb(horns[i], 4, 24);
        glm::vec2 size(0);
        for (const Vertex& v : horn.vertices) size = glm::max(size, v.uv);
        scaleUv(horn, glm::vec2(0.9f * wide, 0.9f * hornStrip) / size, {(float(i) + 0.05f) * wide, 1 - 0.95f * hornStrip});
        append(mesh, horn);
    }
    computeNormals(mesh, 180);
    computeTangents(mesh);
    return figure(glb, name, mesh, pictureTexels, coat);
}

}  // namespace lodestir::generate
