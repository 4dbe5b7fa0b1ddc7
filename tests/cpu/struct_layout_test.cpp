// SPDX-License-Identifier: MIT
// The layout read from a header's text against the layout the compiler made of the same header.
#include "../temporary_folder.h"

#include <framework/graph/struct_layout.h>

#include <framework/core/error.h>
#include <framework/shaders/base/frame.h>
#include <framework/shaders/world/primary_hit.h>
#include <framework/shaders/world/world.h>

#include <gtest/gtest.h>

#include <unistd.h>

namespace lodestir {
namespace {

namespace fs = std::filesystem;

std::vector<Path> shaderFolders() { return {shaderFolder()}; }

template <class T> std::vector<StructField> fieldsOf() {
    return structFields(SharedStruct<T>::name, SharedStruct<T>::header, shaderFolders(), SharedStruct<T>::size);
}

const StructField& named(const std::vector<StructField>& fields, std::string_view name) {
    for (const StructField& field : fields)
        if (field.name == name) return field;
    throw Error("no field " + std::string(name));
}

/// "name type offset count", one line a field.
std::string inWords(const std::vector<StructField>& fields) {
    std::string text;
    for (const StructField& f : fields)
        text += f.name + " " + f.type + " " + std::to_string(f.offset) + " " + std::to_string(f.count) + "\n";
    return text;
}

class StructLayout : public test::FolderTest {
protected:
    std::vector<StructField> read(std::string_view text, std::string_view name, std::size_t size) {
        writeFile(folder / "s.h", text);
        return structFields(name, "s.h", {folder}, size);
    }
    std::string refusal(std::string_view text, std::string_view name, std::size_t size) {
        try {
            read(text, name, size);
        } catch (const Error& error) {
            std::string message = error.what();
            const std::string prefix = folder.string() + "/";
            for (std::size_t at; (at = message.find(prefix)) != message.npos;) message.erase(at, prefix.size());
            return message;
        }
        return "";
    }
};

// If this fails, dumps of hits name the wrong bytes.
TEST_F(StructLayout, PrimaryHitIsWhatTheCompilerMadeOfIt) {
    EXPECT_EQ(inWords(fieldsOf<PrimaryHit>()), "instance uint " + std::to_string(offsetof(PrimaryHit, instance)) + " 0\n" +
                                                   "primitive uint " + std::to_string(offsetof(PrimaryHit, primitive)) + " 0\n" +
                                                   "barycentrics vec2 " + std::to_string(offsetof(PrimaryHit, barycentrics)) + " 0\n" +
                                                   "film vec2 " + std::to_string(offsetof(PrimaryHit, film)) + " 0\n" + "lens vec2 " +
                                                   std::to_string(offsetof(PrimaryHit, lens)) + " 0\n");
}

TEST_F(StructLayout, WorldAndItsPartsAreWhatTheCompilerMadeOfThem) {
    const auto world = fieldsOf<World>();
    EXPECT_EQ(named(world, "levels").offset, offsetof(World, levels));
    EXPECT_EQ(named(world, "levels").type, "uint64_t") << "an address is a number to C++";
    EXPECT_EQ(named(world, "gridScale").offset, offsetof(World, gridScale));
    EXPECT_EQ(named(world, "environmentSize").offset, offsetof(World, environmentSize));
    EXPECT_EQ(named(world, "camera").offset, offsetof(World, camera));
    const auto& camera = named(world, "camera");
    EXPECT_EQ(camera.size, sizeof(CameraRecord));
    EXPECT_EQ(named(camera.members, "focus").offset, offsetof(CameraRecord, focus));

    const Path header = SharedStruct<World>::header;
    const auto instance = structFields("InstanceRecord", header, shaderFolders(), sizeof(InstanceRecord));
    EXPECT_EQ(named(instance, "toWorld").offset, offsetof(InstanceRecord, toWorld));
    EXPECT_EQ(named(instance, "toWorld").count, 3u);
    EXPECT_EQ(named(instance, "flags").offset, offsetof(InstanceRecord, flags));
    const auto material = structFields("MaterialRecord", header, shaderFolders(), sizeof(MaterialRecord));
    EXPECT_EQ(named(material, "normalMap").offset, offsetof(MaterialRecord, normalMap));
    EXPECT_EQ(named(named(material, "normalMap").members, "row1").offset, offsetof(TextureSlotRecord, row1));
    const auto light = structFields("LightRecord", header, shaderFolders(), sizeof(LightRecord));
    EXPECT_EQ(named(light, "range").offset, offsetof(LightRecord, range));
}

TEST_F(StructLayout, FrameAndPushAreWhatTheCompilerMadeOfThem) {
    EXPECT_EQ(named(fieldsOf<FrameInfo>(), "ledger").offset, offsetof(FrameInfo, ledger));
    EXPECT_EQ(named(fieldsOf<FaultRecord>(), "index").offset, offsetof(FaultRecord, index));
    EXPECT_EQ(named(fieldsOf<Push>(), "arguments").offset, offsetof(Push, arguments));
}

TEST_F(StructLayout, BuiltInTypesAreOneNamelessField) {
    const auto fields = structFields("vec3", {}, {}, 12);
    ASSERT_EQ(fields.size(), 1u);
    EXPECT_EQ(inWords(fields), " vec3 0 0\n");
    EXPECT_EQ(fields[0].size, 12u);
    EXPECT_THROW(structFields("vec5", {}, {}, 20), Error);
    EXPECT_THROW(structFields("vec3", {}, {}, 16), Error) << "scalar layout has no padded vec3";
}

TEST_F(StructLayout, ArraysConstantsCommentsAndConditionsAreUnderstood) {
    const char* text = R"(
#define WIDTH 4
#define TRICKY(x) \
    struct S { int wrong; }
#ifdef __cplusplus
struct S { double cpp; };
#else
const uint DEPTH = 0x3u;  // struct S { int comment; };
#endif
/* struct S { int
   comment; }; */
struct Inner { uint a; uint64_t b; };
struct S { float x[3], y; vec3 rows[WIDTH]; Inner inner[DEPTH]; uint tail; mat3 m; };
)";
    EXPECT_EQ(inWords(read(text, "S", 152)),
              "x float 0 3\ny float 12 0\nrows vec3 16 4\ninner Inner 64 3\ntail uint 112 0\nm mat3 116 0\n");
    EXPECT_EQ(inWords(read(text, "Inner", 16)), "a uint 0 0\nb uint64_t 8 0\n") << "8-byte numbers stand at multiples of 8, as in C++";
}

TEST_F(StructLayout, StructsOfIncludedHeadersAreFound) {
    writeFile(folder / "inner/part.h", std::string_view("struct Part { vec2 a; };\n"));
    EXPECT_EQ(inWords(read("#include \"inner/part.h\"\nstruct S { Part p; float q; };\n", "S", 12)), "p Part 0 0\nq float 8 0\n");
}

TEST_F(StructLayout, SaysWhereItCannot) {
    EXPECT_EQ(refusal("struct Reservoir { float a; };\n", "Reservior", 4),
              "s.h: there is no struct \"Reservior\" in s.h and what it includes; did you mean \"Reservoir\"?");
    EXPECT_EQ(refusal("struct S {\n    bool flag;\n};\n", "S", 4), "s.h:2: unknown type \"bool\"; known: S");
    EXPECT_EQ(refusal("struct S {\n    float a[N];\n};\n", "S", 4),
              "s.h:2: the length of an array is \"N\", which is neither a number nor a constant of the headers");
    EXPECT_EQ(refusal("struct S {\n    float a\n    float b;\n};\n", "S", 8), "s.h:3: expected ; in struct \"S\", found float");
    EXPECT_EQ(refusal("struct S {\n    float a;\n", "S", 4), "s.h: struct \"S\" does not end");
    EXPECT_EQ(refusal("struct A { B b; };\nstruct B {\n A a; };\n", "A", 4), "s.h:3: struct \"A\" holds itself");
    EXPECT_EQ(refusal("struct S { float a; };\n", "S", 8),
              "s.h: the fields of \"S\" take 4 bytes, the program has 8; rebuild: the header may have changed since");
    EXPECT_THROW(structFields("S", "nowhere.h", {folder}, 4), Error);
}

}  // namespace
}  // namespace lodestir
