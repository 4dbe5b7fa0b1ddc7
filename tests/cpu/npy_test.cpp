// SPDX-License-Identifier: MIT
// .npy files: known bytes, and what NumPy itself makes of them where it is installed.
#include "../temporary_folder.h"

#include <framework/graph/npy.h>

#include <framework/core/error.h>
#include <framework/shaders/world/primary_hit.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace lodestir {
namespace {

namespace fs = std::filesystem;
using Shape = std::vector<std::size_t>;

class Npy : public test::FolderTest {
protected:
    /// Writes, and returns the header dictionary after checking the frame around it.
    std::string header(std::span<const std::byte> bytes, const std::vector<StructField>& fields, const Shape& shape) {
        writeNpy(folder / "x.npy", bytes, fields, shape);
        const std::string file = readText(folder / "x.npy");
        EXPECT_EQ(file.substr(0, 6), "\x93NUMPY");
        const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(file[i])); };
        const bool second = byte(6) == 2;
        EXPECT_EQ(byte(7), 0u);
        const std::size_t start = second ? 12 : 10;
        const std::size_t length = byte(8) + 256 * byte(9) + (second ? 65536 * byte(10) : 0);
        EXPECT_EQ((start + length) % 64, 0u) << "data must be aligned";
        EXPECT_EQ(file[start + length - 1], '\n');
        EXPECT_EQ(file.substr(start + length), std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        const std::string text = file.substr(start, length);
        return text.substr(0, text.find_last_not_of(" \n") + 1);
    }

    /// What Python prints for a program that finds the file as sys.argv[1].
    std::string python(const std::string& program) {
        writeFile(folder / "p.py", program);
        const std::string command =
            "python3 " + (folder / "p.py").string() + " " + (folder / "x.npy").string() + " > " + (folder / "out").string() + " 2>&1";
        const int status = std::system(command.c_str());
        EXPECT_EQ(status, 0);
        return readText(folder / "out");
    }
    static bool hasNumpy() { return std::system("python3 -c 'import numpy' > /dev/null 2>&1") == 0; }
};

std::vector<StructField> hitFields() { return structFields("PrimaryHit", "world/primary_hit.h", {shaderFolder()}, sizeof(PrimaryHit)); }

TEST_F(Npy, PlainTypesHaveAPlainHeader) {
    const std::array<float, 6> numbers{1, 2, 3, 4, 5, 6};
    const auto bytes = std::as_bytes(std::span(numbers));
    EXPECT_EQ(header(bytes, structFields("float", {}, {}, 4), {2, 3}), "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }");
    EXPECT_EQ(header(bytes, structFields("vec3", {}, {}, 12), {2}), "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }");
    EXPECT_EQ(header(bytes, structFields("uint", {}, {}, 4), {6}), "{'descr': '<u4', 'fortran_order': False, 'shape': (6,), }");
    EXPECT_EQ(header(bytes, structFields("ivec2", {}, {}, 8), {1, 3}), "{'descr': '<i4', 'fortran_order': False, 'shape': (1, 3, 2), }");
    EXPECT_EQ(header(bytes.first(4), structFields("float", {}, {}, 4), {}), "{'descr': '<f4', 'fortran_order': False, 'shape': (), }");
    EXPECT_EQ(header({}, structFields("vec4", {}, {}, 16), {0}), "{'descr': '<f4', 'fortran_order': False, 'shape': (0, 4), }");
}

TEST_F(Npy, StructsHaveNamedFields) {
    const std::array<PrimaryHit, 2> hits{};
    EXPECT_EQ(header(std::as_bytes(std::span(hits)), hitFields(), {1, 2}),
              "{'descr': [('instance', '<u4'), ('primitive', '<u4'), ('barycentrics', '<f4', (2,)), ('film', '<f4', (2,)), ('lens', '<f4', "
              "(2,))], "
              "'fortran_order': False, 'shape': (1, 2), }");
}

TEST_F(Npy, GapsArraysAndNestedStructsAreKept) {
    writeFile(folder / "s.h", std::string_view("struct In { uint a; uint64_t b; };\nstruct S { uint x; In in[2]; mat3 m; };\n"));
    const std::vector<std::byte> bytes(80);
    EXPECT_EQ(header(bytes, structFields("S", "s.h", {folder}, 80), {1}),
              "{'descr': [('x', '<u4'), ('', '|V4'), ('in', [('a', '<u4'), ('', '|V4'), ('b', '<u8')], (2,)), ('m', '<f4', (3, 3)), ('', "
              "'|V4')], "
              "'fortran_order': False, 'shape': (1,), }");
}

TEST_F(Npy, LongHeadersTakeTheSecondVersion) {
    std::vector<StructField> fields;
    for (std::size_t i = 0; i < 3000; ++i)
        fields.push_back({.name = "a_rather_long_name_" + std::to_string(i), .type = "float", .offset = 4 * i, .size = 4, .members = {}});
    const std::vector<std::byte> bytes(12000);
    EXPECT_GT(header(bytes, fields, {1}).size(), 65536u);
    EXPECT_EQ(readText(folder / "x.npy")[6], '\x02');
}

TEST_F(Npy, SizesThatDoNotFitAreRefused) {
    const std::vector<std::byte> bytes(100);
    EXPECT_THROW(writeNpy(folder / "x.npy", bytes, hitFields(), Shape{3}), Error);
    EXPECT_THROW(writeNpy(folder / "x.npy", bytes, structFields("vec3", {}, {}, 12), Shape{5}), Error) << "20 bytes are no vec3";
    EXPECT_THROW(writeNpy(folder / "x.npy", bytes, {}, Shape{1}), Error);
    EXPECT_FALSE(fs::exists(folder / "x.npy"));
}

// If this fails, our idea of the format isn't NumPy's.
TEST_F(Npy, NumpyReadsTheSameValues) {
    if (!hasNumpy()) GTEST_SKIP() << "python3 has no numpy here, so only the bytes were checked";
    std::array<PrimaryHit, 6> hits{};
    for (std::uint32_t i = 0; i < 6; ++i)
        hits[i] = {
            .instance = i, .primitive = 0xffffffffu - i, .barycentrics = {i + 0.25f, i + 0.5f}, .film = {-1.0f, float(i)}, .lens = {0, 7}};
    writeNpy(folder / "x.npy", std::as_bytes(std::span(hits)), hitFields(), Shape{2, 3});
    EXPECT_EQ(python("import sys, numpy\na = numpy.load(sys.argv[1])\nprint(a.shape, a['primitive'][1, 2], a['barycentrics'][1, "
                     "0].tolist(), a['film'].shape, a['lens'].sum())\n"),
              "(2, 3) 4294967290 [3.25, 3.5] (2, 3, 2) 42.0\n");

    writeFile(folder / "s.h", std::string_view("struct In { uint a; uint64_t b; };\nstruct S { uint x; In in[2]; mat3 m; };\n"));
    std::array<std::uint32_t, 40> words{};
    for (std::uint32_t i = 0; i < 40; ++i) words[i] = i;
    words[5] = 0;  // high word of in[0].b
    writeNpy(folder / "x.npy", std::as_bytes(std::span(words)), structFields("S", "s.h", {folder}, 80), Shape{2});
    EXPECT_EQ(
        python("import sys, numpy\na = numpy.load(sys.argv[1])\n"
               "print(a.dtype.itemsize, a['x'].tolist(), a['in']['a'].tolist(), a['in']['b'][0, 0], a['m'].view('<u4')[0, 1].tolist())\n"),
        "80 [0, 20] [[2, 6], [22, 26]] 4 [13, 14, 15]\n");
}

}  // namespace
}  // namespace lodestir
