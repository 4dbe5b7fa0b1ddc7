// SPDX-License-Identifier: MIT
// A game of chess on a walnut and maple board: the position of the "Immortal Game" (Anderssen - Kieseritzky, London 1851) before mate.
#include <cmath>
#include <string>

#include "kit/backdrop.h"
#include "kit/chess_pieces.h"
#include "kit/glb.h"
#include "kit/noise.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

/// After 22. Qf6+ Nxf6; rank 8 first, capitals are White.
constexpr const char* position[8] = {"r.bk...r", "p..pBpNp", "n....n..", ".p.NP..P", "......P.", "...P....", "P.P.K...", "q.....b."};

/// Turned wood: grain along the piece's height (v), varnished.
Textures paintTurned(const Wood& wood, uint32_t seed) {
    return paint({.width = 1024, .height = 1024, .metres = {0.12f, 0.12f}, .repeats = false, .smooth = true}, [&](const glm::vec2& p) {
        // The picture's left and right meet on the piece: the grain is read around a circle.
        const float a = p.x / 0.12f * 6.2831853f;
        const Noise noise{seed};
        const glm::vec3 q(std::cos(a) * 0.5f, p.y * 30, std::sin(a) * 0.5f);
        const float figure = noise.fractal(q * glm::vec3(5, 0.6f, 5) + 0.4f * noise.at(q * 0.7f), 4),
                    fibre = noise.fractal(q * glm::vec3(60, 2.0f, 60), 3);
        Surface s;
        s.color = glm::mix(wood.early, wood.late, glm::clamp(0.4f + 0.32f * figure + 0.25f * fibre, 0.0f, 1.0f));
        s.roughness = wood.roughness + 0.05f * fibre;
        return s;
    });
}

/// The playing field: each square a veneer of its own, dark at the lower left.
Textures paintField(const Wood& light, const Wood& dark) {
    return paint({.width = 2048, .height = 2048, .metres = {0.48f, 0.48f}, .repeats = false, .smooth = true}, [&](const glm::vec2& p) {
        const glm::ivec2 square(glm::clamp(glm::floor(p / 0.06f), 0.0f, 7.0f));
        const glm::vec2 within = p - (glm::vec2(square) + 0.5f) * 0.06f;
        const bool pale = (square.x + square.y) % 2 == 0;
        Surface s = boardAt(pale ? light : dark, within, hash(uint32_t(square.x), uint32_t(square.y), 5u));
        const glm::vec2 edge = 0.03f - glm::abs(within);
        s.color *= 1 - 0.5f * (1 - glm::smoothstep(0.0f, 0.0004f, std::min(edge.x, edge.y)));
        s.roughness = 0.22f;
        return s;
    });
}

Glb makeChessboard() {
    Glb glb;
    const Wood boxwood{.early = {0.66f, 0.47f, 0.25f}, .late = {0.50f, 0.31f, 0.13f}, .roughness = 0.20f};
    const Wood ebony{.early = {0.030f, 0.020f, 0.014f}, .late = {0.012f, 0.008f, 0.006f}, .roughness = 0.16f};
    const Wood maple{.early = {0.64f, 0.50f, 0.34f}, .late = {0.54f, 0.39f, 0.24f}, .roughness = 0.22f, .pores = 0.2f};
    const int white = glb.addMaterial(glb.dressed({.name = "boxwood"}, paintTurned(boxwood, 41)));
    const int black = glb.addMaterial(glb.dressed({.name = "ebony"}, paintTurned(ebony, 43)));

    // Each kind once for each side that has it; both wear the same vertices.
    const std::string letters = "prnbqk";
    const char* names[] = {"pawn", "rook", "knight", "bishop", "queen", "king"};
    int geometries[6], meshes[2][6];
    for (size_t kind = 0; kind < 6; ++kind)
        geometries[kind] = glb.addGeometry(chessPiece(Piece(kind))), meshes[0][kind] = meshes[1][kind] = Material::none;
    Random random(7);
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 8; ++column) {
            const char letter = position[row][column];
            if (letter == '.') continue;
            const bool isWhite = letter >= 'A' && letter <= 'Z';
            const size_t kind = letters.find(char(letter | 0x20));
            const glm::vec3 place(float(column) - 3.5f + random.between(-0.05f, 0.05f), 0,
                                  float(row) - 3.5f + random.between(-0.05f, 0.05f));
            const float turn = kind == 2 ? (isWhite ? 90.0f : -90.0f) + random.between(-25, 25) : random.between(0, 360);
            const std::string name = std::string(isWhite ? "white_" : "black_") + names[kind];
            int& mesh = meshes[isWhite ? 0 : 1][kind];
            if (mesh == Material::none) mesh = glb.addMesh(name, {{geometries[kind], isWhite ? white : black}});
            const std::string square{char('a' + column), char('8' - row)};
            glb.addNode(name + "_" + square, mesh, {.translation = place, .rotation = turnY(turn)});
        }

    Model board{"board", {}};
    board.add(glb.addMaterial(glb.dressed({.name = "field"}, paintField(maple, walnut()))), rectangle({-4, 0, -4}, {8, 0, 0}, {0, 0, 8}));
    const int frame = glb.addMaterial(glb.dressed({.name = "frame"}, paintPanel(walnut(), 3, 1024)));
    for (int side = 0; side < 4; ++side) {
        Mesh rail = roundedBox({9.4f, 0.5f, 0.68f}, 0.06f, 4);
        scaleUv(rail, 0.08f / panelSize, {0.13f * float(side), 0.2f * float(side)});
        const glm::mat4 turn(glm::mat3_cast(turnY(90.0f * float(side))));
        board.add(frame, placed(placed(rail, glm::vec3(0, -0.21f, 4.345f)), turn));
    }
    glb.addNode(board);

    addTable(glb, {.size = {40, 0.4f, 30}, .edge = 0.1f, .centre = {0, -0.66f, -3}, .grain = 0.05f, .material = "oak", .wood = oak(), .seed = 15});
    addWall(glb, {.name = "wall", .color = {0.10f, 0.14f, 0.12f}, .roughness = 0.9f}, {-30, 20, -15}, {60, 0, 0}, {0, -24, 0});
    const int glowing = glb.addMaterial({.name = "window", .color = glm::vec3(0), .emission = {17, 15.5f, 13.5f}});
    Model window{"window", {}};
    window.add(glowing, placed(rectangle({0, 0, 0}, {0, 0, -7}, {0, -7, 0}), glm::vec3(-13, 11, 1)));
    glb.addNode(window);
    const int lamp = glb.addMaterial({.name = "lamp", .color = glm::vec3(0), .emission = {9, 7, 4.6f}});
    Model shade{"lamp", {}};
    shade.add(lamp, placed(rectangle({0, 0, 0}, {2.5f, 0, 0}, {0, 0, -5}), glm::vec3(6, 9, 1)));
    glb.addNode(shade);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeChessboard, "--levels 3 --ratio 4")

}  // namespace lodestir::generate
