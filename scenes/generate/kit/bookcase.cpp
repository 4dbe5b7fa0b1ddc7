// SPDX-License-Identifier: MIT
// A bookcase: see bookcase.h.
#include "bookcase.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "cloth.h"
#include "foliage.h"
#include "joinery.h"
#include "random.h"
#include "shapes.h"
#include "tableware.h"

namespace lodestir::generate {

namespace {

constexpr float depth = 0.30f, board = 0.022f;

/// Bookbinder's cloth, muted.
constexpr glm::vec3 cloths[] = {{0.33f, 0.045f, 0.035f}, {0.05f, 0.11f, 0.20f},  {0.055f, 0.13f, 0.075f},  {0.52f, 0.42f, 0.26f},
                                {0.62f, 0.57f, 0.48f},   {0.30f, 0.15f, 0.055f}, {0.025f, 0.027f, 0.032f}, {0.46f, 0.24f, 0.045f},
                                {0.16f, 0.22f, 0.25f},   {0.40f, 0.13f, 0.07f},  {0.10f, 0.20f, 0.21f},    {0.66f, 0.61f, 0.54f},
                                {0.21f, 0.06f, 0.085f}};

void tint(Mesh& mesh, const glm::vec3& color) {
    for (Vertex& v : mesh.vertices) v.color = color;
    mesh.hasColors = true;
}

glm::mat4 at(const glm::vec3& position) { return glm::translate(glm::mat4(1), position); }

}  // namespace

Book anyBook(uint32_t seed) {
    Random random(seed);
    const float height = 0.185f + 0.09f * random.next() * random.next() + 0.03f * random.next();
    const glm::vec3 size(0.016f + 0.034f * random.next() * random.next(), height, height * random.between(0.66f, 0.74f));
    const glm::vec3 cloth = cloths[random.below(int(std::size(cloths)))] * random.between(0.8f, 1.15f);
    return {size, cloth, random.next() < 0.45f};
}

void addBook(Model& model, const Palette& palette, const Book& book, const glm::mat4& where) {
    constexpr float cover = 0.0028f, overhang = 0.0035f;
    const glm::vec3 s = book.size;
    const auto part = [&](const glm::vec3& size, float radius, const glm::vec3& centre) {
        Mesh mesh = roundedBox(size, radius, 1, Axis::y);
        scaleUv(mesh, glm::vec2(1 / weaveSize));
        return placed(mesh, where * at(centre));
    };
    Mesh cloth;
    for (float side : {-1.0f, 1.0f})
        append(cloth, part({cover, s.y, s.z - 0.004f}, 0.0011f, {side * (s.x - cover) / 2, s.y / 2, -s.z / 2 - 0.002f}));
    // The spine is rounded across.
    const float hollow = std::min(s.x * 0.22f, 0.007f);
    append(cloth, part({s.x - 0.0006f, s.y, 2 * hollow}, hollow * 0.95f, {0, s.y / 2, -hollow}));
    tint(cloth, book.cloth);
    model.add(palette.books, cloth);
    model.add(palette.paper, placed(plainBox({s.x - 2 * cover, s.y - 2 * overhang, s.z - overhang - 0.006f}),
                                    where * at({0, s.y / 2, -s.z / 2 - 0.001f + overhang / 2})));
    if (book.gilded) {
        // A panel of foil for the title and two rules, just proud of the cloth.
        const float width = (s.x - 2 * hollow * 0.6f) * 0.8f;
        const auto foil = [&](float y, float height) {
            model.add(palette.gilt, placed(rectangle({-width / 2, y + height / 2, 0.00025f}, {width, 0, 0}, {0, -height, 0}), where));
        };
        foil(s.y * 0.80f, s.y * 0.11f);
        foil(s.y * 0.14f, 0.0022f);
        foil(s.y * 0.17f, 0.0012f);
    }
}

namespace {

/// Fills a shelf from x0 to x1 at height y with upright books; the last one leans where there is room. Returns where the books end.
float fillRow(Model& shelf, const Palette& palette, Random& random, float x0, float x1, float y, float clearance) {
    float x = x0;
    while (true) {
        Book book = anyBook(random.bits());
        book.size.y = std::min(book.size.y, clearance - 0.02f);
        book.size.z = std::min(book.size.z, depth - 0.06f);
        if (x + book.size.x > x1) break;
        const float pushed = random.between(0.015f, 0.035f);  // not in line: hands put them back
        addBook(shelf, palette, book, at({x + book.size.x / 2, y, depth - pushed}));
        x += book.size.x + 0.0006f;
    }
    return x;
}

void addLeaning(Model& shelf, const Palette& palette, Random& random, float x, float y, float clearance) {
    Book book = anyBook(random.bits());
    book.size.y = std::min(book.size.y, clearance - 0.03f);
    book.size.z = std::min(book.size.z, depth - 0.06f);
    const float angle = glm::radians(random.between(9, 15));
    // Its head rests against the row, its foot slid away: turned about the lower right edge.
    const float foot = x + book.size.y * std::sin(angle) + book.size.x * std::cos(angle) + 0.001f;
    addBook(shelf, palette, book, glm::rotate(at({foot, y, depth - 0.03f}), angle, glm::vec3(0, 0, 1)) * at({-book.size.x / 2, 0, 0}));
}

void addPile(Model& shelf, const Palette& palette, Random& random, float x, float y, int count) {
    for (int i = 0; i < count; ++i) {
        Book book = anyBook(random.bits());
        book.size.z = std::min(book.size.z, depth - 0.06f);
        // Laid on its side: thickness becomes height, the spine stays in front.
        const glm::mat4 lay = glm::rotate(at({x - book.size.y / 2 + random.between(-0.01f, 0.01f), y + book.size.x / 2, depth - 0.035f}),
                                          glm::radians(-90.0f), glm::vec3(0, 0, 1));
        addBook(shelf, palette, book, glm::rotate(lay, glm::radians(random.between(-5, 5)), glm::vec3(1, 0, 0)));
        y += book.size.x + 0.0004f;
    }
}

}  // namespace

Model bookcase(const Palette& palette, uint32_t seed, float width, float height) {
    Random random(seed);
    Model shelf{"bookcase", {}};
    const auto add = [&](const glm::vec3& size, Axis grain, const glm::vec3& centre) {
        shelf.add(palette.oak, placed(plank(size, grain, random.bits(), 0.0025f), centre));
    };
    constexpr float plinth = 0.07f;
    for (float x : {-1.0f, 0.0f, 1.0f})
        add({board, height - plinth, depth}, Axis::y, {x * (width - board) / 2, plinth + (height - plinth) / 2, depth / 2});
    add({width - 0.04f, plinth, 0.02f}, Axis::x, {0, plinth / 2, depth - 0.05f});
    add({width - 0.01f, height - plinth - 0.01f, 0.008f}, Axis::y, {0, (height + plinth) / 2, 0.006f});

    constexpr int rows = 5;
    const float pitch = (height - plinth - board) / rows, bay = (width - 3 * board) / 2;
    for (int row = 0; row <= rows; ++row)
        for (float side : {-1.0f, 1.0f})
            add({bay - 0.0004f, board, depth - 0.012f}, Axis::x,
                {side * (bay + board) / 2, plinth + board / 2 + float(row) * pitch, depth / 2 - 0.001f});

    const PlantMaterials green{palette.leaf, palette.stem};
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < 2; ++column) {
            const float left = -width / 2 + board + float(column) * (bay + board) + 0.001f, right = left + bay - 0.002f;
            const float y = plinth + board + float(row) * pitch + 0.0005f, clearance = pitch - board;
            const auto object = [&](const Model& thing, float x, float turn) {
                for (const auto& [material, mesh] : thing.parts)
                    shelf.add(material, placed(mesh, glm::rotate(at({x, y, depth * 0.55f}), turn, glm::vec3(0, 1, 0))));
            };
            switch ((row * 2 + column) % 10) {
            case 1: {
                const float end = fillRow(shelf, palette, random, left, left + bay * 0.58f, y, clearance);
                addLeaning(shelf, palette, random, end, y, clearance);
                break;
            }
            case 2:
                object(vase("", palette.stoneware, 0.20f, 0.075f), left + 0.11f, 0);
                object(vase("", palette.clay, 0.13f, 0.055f), left + 0.24f, 0);
                fillRow(shelf, palette, random, left + 0.34f, right, y, clearance);
                break;
            case 4: {
                const float end = fillRow(shelf, palette, random, left, left + bay * 0.45f, y, clearance);
                addLeaning(shelf, palette, random, end, y, clearance);
                addPile(shelf, palette, random, right - 0.15f, y, 4);
                break;
            }
            case 5:
                fillRow(shelf, palette, random, left, left + bay * 0.62f, y, clearance);
                object(bowl("", palette.glaze, 0.095f), right - 0.12f, 0);
                break;
            case 7:
                addPile(shelf, palette, random, left + 0.15f, y, 5);
                fillRow(shelf, palette, random, left + 0.36f, right, y, clearance);
                break;
            case 9: {
                const float end = fillRow(shelf, palette, random, left, left + bay * 0.40f, y, clearance);
                addLeaning(shelf, palette, random, end, y, clearance);
                object(pot("", palette.clay, palette.soil, 0.11f), right - 0.16f, 0);
                for (const auto& [material, mesh] : rubberFig("", random.bits(), 0.21f, 16, green).parts)
                    shelf.add(material, placed(mesh, at({right - 0.16f, y + 0.095f, depth * 0.55f})));
                break;
            }
            default: fillRow(shelf, palette, random, left, right, y, clearance);
            }
        }
    return shelf;
}

}  // namespace lodestir::generate
