// SPDX-License-Identifier: MIT
// Image files: round trips, rounding, windows, and what must be refused.
#include "../temporary_folder.h"
#include "png_bytes.h"

#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/color_map.h>
#include <framework/image/exr.h>
#include <framework/image/hdr.h>
#include <framework/image/image_file.h>
#include <framework/image/png.h>
#include <framework/image/srgb.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfTileDescriptionAttribute.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

namespace lodestir {
namespace {

namespace fs = std::filesystem;

class Images : public test::FolderTest {};

template <class Call> std::string refusal(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

ImageData noise(int width, int height, int channels) {
    ImageData image = makeImage(width, height, channels);
    std::mt19937 random(1);
    for (float& value : image.values)
        value = std::exp2(static_cast<float>(random() % 4000) / 200 - 12) * (random() % 8 == 0 ? -1.0f : 1.0f);
    return image;
}

/// Equal bits; NaNs too.
void expectSame(const ImageData& a, const ImageData& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    ASSERT_EQ(a.channels, b.channels);
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(a.values[i]), std::bit_cast<std::uint32_t>(b.values[i])) << "value " << i;
    }
}

/// Real image files: in the folder that $LODESTIR_ASSETS names, else in one that may lie beside the project.
Path assets(const char* name) {
    const char* chosen = std::getenv("LODESTIR_ASSETS");
    return (chosen ? Path(chosen) : Path(LODESTIR_SOURCE_DIR) / "../shared/assets") / name;
}

#define NEED_ASSETS(path) \
    if (!fs::exists(path)) GTEST_SKIP() << "no sample files here; LODESTIR_ASSETS may name a folder of them"

// ---- OpenEXR

TEST_F(Images, ExrKeepsEveryBitOfSingleFloats) {
    for (const int channels : {1, 2, 3, 4}) {
        ImageData image = noise(37, 23, channels);
        image.values[0] = std::numeric_limits<float>::infinity();
        image.values[1] = std::numeric_limits<float>::quiet_NaN();
        image.values[2] = std::numeric_limits<float>::denorm_min();
        image.values[3] = -0.0f;
        writeExr(folder / "a.exr", image);
        expectSame(readExr(folder / "a.exr"), image);
    }
}

// If this fails, saved images are biased, or one bright pixel makes every later mean infinite.
TEST_F(Images, ExrRoundsHalvesToNearestEvenAndKeepsThemFinite) {
    const float inf = std::numeric_limits<float>::infinity(), ulp = 0x1p-10f;  // spacing of halves from 1 to 2
    const float given[] = {1 + ulp / 2, 1 + 1.5f * ulp, 1 + 0.51f * ulp, 65504,    65520,     1e9f, -1e30f,
                           inf,         -inf,           0x1p-24f,        0x1p-25f, 0x1.8p-25f};
    const float stored[] = {1, 1 + 2 * ulp, 1 + ulp, 65504, 65504, 65504, -65504, inf, -inf, 0x1p-24f, 0, 0x1p-24f};
    ImageData image = makeImage(12, 1, 1);
    std::copy(std::begin(given), std::end(given), image.values.begin());
    writeExr(folder / "h.exr", image, {.type = ExrOptions::Type::half});
    const ImageData read = readExr(folder / "h.exr");
    for (int x = 0; x < 12; ++x) EXPECT_EQ(read.at(x, 0, 0), stored[x]) << given[x];
    image.values.assign(12, std::nanf(""));
    writeExr(folder / "h.exr", image, {.type = ExrOptions::Type::half});
    EXPECT_TRUE(std::isnan(readExr(folder / "h.exr").at(5, 0, 0)));
}

TEST_F(Images, ExrIsTheSameBytesEachTimeAndCarriesAttributes) {
    const ImageData image = noise(64, 40, 3);
    const ExrOptions options{.type = ExrOptions::Type::half,
                             .attributes = {{"lodestir", "{\"format\": 1}"}, {"note", std::string(100000, 'x')}}};
    writeExr(folder / "a.exr", image, options);
    writeExr(folder / "b.exr", image, options);
    EXPECT_EQ(readText(folder / "a.exr"), readText(folder / "b.exr"));
    const ExrFile read = readExrFile(folder / "a.exr");
    EXPECT_EQ(read.attributes, options.attributes);
    EXPECT_EQ(read.channels, (std::vector<std::string>{"R", "G", "B"}));
}

TEST_F(Images, ExrChannelsGoByName) {
    const auto order = [&](std::vector<std::string> names) {
        ImageData image = makeImage(2, 1, static_cast<int>(names.size()));
        for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>(i % names.size());
        writeExr(folder / "n.exr", image, {.channels = names});
        const ExrFile read = readExrFile(folder / "n.exr");
        std::string text;
        for (std::size_t c = 0; c < read.channels.size(); ++c) {
            text += read.channels[c] + " ";
            EXPECT_EQ(names[static_cast<std::size_t>(read.image.at(1, 0, static_cast<int>(c)))], read.channels[c]);
        }
        return text;
    };
    EXPECT_EQ(order({"A", "B", "G", "R"}), "R G B A ");
    EXPECT_EQ(order({"B", "G", "R", "Z", "normal.X"}), "R G B ");
    EXPECT_EQ(order({"b", "g", "r"}), "r g b ");
    EXPECT_EQ(order({"Blue", "Green", "Red", "ALPHA"}), "Red Green Blue ALPHA ");
    EXPECT_EQ(order({"L.Combined.A", "L.Combined.B", "L.Combined.G", "L.Combined.R", "L.Depth.Z"}),
              "L.Combined.R L.Combined.G L.Combined.B L.Combined.A ");
    EXPECT_EQ(order({"beauty.blue", "beauty.green", "beauty.red"}), "beauty.red beauty.green beauty.blue ");
    EXPECT_EQ(order({"albedo.B", "albedo.G", "albedo.R", "B", "G", "R"}), "R G B ") << "the layer without a name is the image";
    EXPECT_EQ(order({"V.AO.B", "V.AO.G", "V.AO.R", "V.Combined.B", "V.Combined.G", "V.Combined.R"}),
              "V.Combined.R V.Combined.G V.Combined.B ")
        << "its name says so";
    EXPECT_EQ(order({"Z", "albedo.B", "albedo.G", "albedo.R"}), "albedo.R albedo.G albedo.B ") << "the only one that is colour";
    EXPECT_EQ(order({"a.B", "a.G", "a.R", "b.B", "b.G", "b.R"}), "a.R a.G a.B ") << "else the first";
    EXPECT_EQ(order({"N.Z", "N.Y", "N.X"}), "N.X N.Y N.Z ") << "Y beside X is no grey";
    EXPECT_EQ(order({"U.Y", "U.Z"}), "U.Y ");
    EXPECT_EQ(order({"Z"}), "Z ");
    EXPECT_EQ(order({"V", "U", "A"}), "U V A ") << "no colour at all: as they come";
    EXPECT_EQ(order({"Y"}), "Y ");
    EXPECT_EQ(order({"A", "Y"}), "Y A ");
    EXPECT_EQ(order({"Z", "X", "Y"}), "X Y Z ");
    EXPECT_NE(refusal([&] { writeExr(folder / "n.exr", makeImage(1, 1, 3), {.channels = {"R"}}); }), "");
    EXPECT_NE(refusal([&] { writeExr(folder / "n.exr", makeImage(1, 1, 5)); }), "");
}

// If this fails, a difference in red is taken for one in opacity, and not compared.
TEST_F(Images, ExrOnlyAlphaIsOpacity) {
    const auto hasOpacity = [&](std::vector<std::string> names) {
        writeExr(folder / "n.exr", makeImage(2, 1, static_cast<int>(names.size())), {.channels = names});
        const ImageData image = readExr(folder / "n.exr");
        EXPECT_EQ(image.channels, static_cast<int>(names.size()));
        EXPECT_EQ(withoutOpacity(image).channels, image.channels - (image.hasOpacity ? 1 : 0));
        return image.hasOpacity;
    };
    EXPECT_TRUE(hasOpacity({"x.A", "x.B", "x.G", "x.R"}));
    EXPECT_TRUE(hasOpacity({"y", "alpha"}));
    EXPECT_FALSE(hasOpacity({"R", "G", "B"}));
    EXPECT_FALSE(hasOpacity({"R", "G"})) << "motion";
    EXPECT_FALSE(hasOpacity({"0", "1", "2", "3"}));
    ImageData grey = makeImage(2, 1, 2);
    grey.hasOpacity = true;
    writeExr(folder / "n.exr", grey);
    EXPECT_EQ(readExrFile(folder / "n.exr").channels, (std::vector<std::string>{"Y", "A"}));
    EXPECT_TRUE(readExr(folder / "n.exr").hasOpacity);
}

TEST_F(Images, ExrSaysWhichLayerItTakes) {
    const auto said = [&](std::vector<std::string> names) {
        writeExr(folder / "n.exr", makeImage(1, 1, static_cast<int>(names.size())), {.channels = names});
        testing::internal::CaptureStderr();
        readExr(folder / "n.exr");
        return testing::internal::GetCapturedStderr();
    };
    const std::string start = (folder / "n.exr").string() + ": ";
    EXPECT_EQ(said({"a.B", "a.G", "a.R", "b.B", "b.G", "b.R"}), start + "takes \"a\" of 2 layers; the others: b\n");
    EXPECT_EQ(said({"B", "G", "R", "b.B", "b.G", "b.R"}), start + "takes the unnamed one of 2 layers; the others: b\n");
    EXPECT_EQ(said({"B", "G", "R", "Z", "n.X", "n.Y", "n.Z"}), "");
    EXPECT_EQ(said({"Z"}), "");
    EXPECT_NE(said({"id", "depth"}).find("none of its channels is known as colour; they are taken in the order depth, id"),
              std::string::npos);
}

TEST_F(Images, ExrChannelsAskedForAreThose) {
    writeExr(folder / "n.exr", {1, 1, 4, {1, 2, 3, 4}}, {.channels = {"R", "G", "B", "square"}});
    EXPECT_EQ(readExrChannels(folder / "n.exr", {"square", "R"}).image.values, (std::vector<float>{4, 1}));
    EXPECT_NE(refusal([&] { readExrChannels(folder / "n.exr", {"A"}); }).find("has no channel \"A\""), std::string::npos);
}

/// A frame buffer of one channel whose pixel (x, y) is x + 100 y, in any window.
struct Ramp {
    explicit Ramp(Imath::Box2i window, const char* name = "R") {
        const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) values.push_back(static_cast<float>(window.min.x + x + 100 * (window.min.y + y)));
        }
        buffer.insert(name,
                      Imf::Slice::Make(Imf::FLOAT, values.data(), window, sizeof(float), sizeof(float) * static_cast<std::size_t>(width)));
    }
    std::vector<float> values;
    Imf::FrameBuffer buffer;
};

// If this fails, crops and overscan are compared with the wrong pixels.
TEST_F(Images, ExrDataWindowsLieInTheDisplayWindow) {
    const Imath::Box2i display({10, 20}, {17, 25}), data({12, 18}, {30, 22});
    Ramp ramp(data);
    Imf::Header header(display, data);
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    {
        Imf::OutputFile file((folder / "w.exr").c_str(), header);
        file.setFrameBuffer(ramp.buffer);
        file.writePixels(5);
    }
    const ImageData image = readExr(folder / "w.exr");
    ASSERT_EQ(image.width, 8);
    ASSERT_EQ(image.height, 6);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 8; ++x) EXPECT_EQ(image.at(x, y, 0), x >= 2 && y <= 2 ? 10 + x + 100 * (20 + y) : 0) << x << ", " << y;
    }
    header.displayWindow() = Imath::Box2i({500, 500}, {501, 502});  // nothing in common
    {
        Imf::OutputFile file((folder / "w.exr").c_str(), header);
        file.setFrameBuffer(ramp.buffer);
        file.writePixels(5);
    }
    EXPECT_EQ(readExr(folder / "w.exr").values, std::vector<float>(6, 0.0f));
}

TEST_F(Images, ExrReadsTilesIntegersAndTheFirstPart) {
    const Imath::Box2i window({0, 0}, {69, 44});
    Ramp ramp(window);
    Imf::Header header(70, 45);
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    header.setTileDescription(Imf::TileDescription(32, 16, Imf::MIPMAP_LEVELS));
    {
        Imf::TiledOutputFile file((folder / "t.exr").c_str(), header);
        for (int level = 0; level < file.numLevels(); ++level) {
            file.setFrameBuffer(ramp.buffer);
            file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
        }
    }
    EXPECT_EQ(readExr(folder / "t.exr").values, ramp.values);

    Imf::Header parts[2] = {Imf::Header(70, 45), Imf::Header(70, 45)};
    for (Imf::Header& part : parts) {
        part.channels().insert(&part == parts ? "R" : "Z", Imf::Channel(Imf::FLOAT));
        part.setName(&part == parts ? "first" : "second");
        part.setType(Imf::SCANLINEIMAGE);
    }
    {
        Imf::MultiPartOutputFile file((folder / "m.exr").c_str(), parts, 2);
        Imf::OutputPart first(file, 0), second(file, 1);
        first.setFrameBuffer(ramp.buffer);
        first.writePixels(45);
        Ramp other(window, "Z");
        second.setFrameBuffer(other.buffer);
        second.writePixels(45);
    }
    EXPECT_EQ(readExr(folder / "m.exr").values, ramp.values);
    EXPECT_EQ(readExrFile(folder / "m.exr").channels, std::vector<std::string>{"R"});

    // The part that is the image need not be the first.
    const auto chosen = [&](std::vector<std::pair<const char*, const char*>> namesAndChannels) {
        std::vector<Imf::Header> headers;
        for (const auto& [name, channel] : namesAndChannels) {
            headers.emplace_back(70, 45);
            headers.back().channels().insert(channel, Imf::Channel(Imf::FLOAT));
            headers.back().setName(name);
            headers.back().setType(Imf::SCANLINEIMAGE);
        }
        {
            Imf::MultiPartOutputFile file((folder / "p.exr").c_str(), headers.data(), static_cast<int>(headers.size()));
            for (std::size_t i = 0; i < headers.size(); ++i) {
                Ramp values(window, namesAndChannels[i].second);
                for (float& value : values.values) value += static_cast<float>(i) * 10000;
                Imf::OutputPart part(file, static_cast<int>(i));
                part.setFrameBuffer(values.buffer);
                part.writePixels(45);
            }
        }
        return readExr(folder / "p.exr").values[0] / 10000;
    };
    EXPECT_EQ(chosen({{"depth", "Z"}, {"albedo", "Y"}}), 1);
    EXPECT_EQ(chosen({{"albedo", "Y"}, {"beauty.left", "Y"}}), 1);
    EXPECT_EQ(chosen({{"albedo", "Y"}, {"shadow", "shadow.Y"}}), 0);
    EXPECT_EQ(chosen({{"depth", "Z"}, {"id", "id"}}), 0);

    unsigned numbers[] = {0, 1, 70000, 4000000000u};
    Imf::Header integers(4, 1);
    integers.channels().insert("id", Imf::Channel(Imf::UINT));
    Imf::FrameBuffer buffer;
    buffer.insert("id", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(numbers), 4, 16));
    {
        Imf::OutputFile file((folder / "u.exr").c_str(), integers);
        file.setFrameBuffer(buffer);
        file.writePixels(1);
    }
    EXPECT_EQ(readExr(folder / "u.exr").values, (std::vector<float>{0, 1, 70000, 4e9f}));
}

TEST_F(Images, ExrLuminanceAndChromaBecomeColour) {
    std::vector<Imf::Rgba> pixels(32 * 16, Imf::Rgba(half(0.5f), half(0.25f), half(0.125f)));
    {
        Imf::RgbaOutputFile file((folder / "yc.exr").c_str(), 32, 16, Imf::WRITE_YC);
        file.setFrameBuffer(pixels.data(), 1, 32);
        file.writePixels(16);
    }
    const ExrFile read = readExrFile(folder / "yc.exr");
    EXPECT_EQ(read.channels, (std::vector<std::string>{"R", "G", "B"}));
    for (std::size_t i = 0; i < read.image.values.size(); ++i) {
        ASSERT_NEAR(read.image.values[i], 0.5 / (1 << i % 3), 0.005) << i;  // luminance and chroma are rounded to halves
    }
}

// OpenEXR's own writer of a layer of luminance and chroma: R, G, B must come back under any name of the layer.
TEST_F(Images, ExrLuminanceAndChromaOfALayerBecomeColour) {
    std::vector<Imf::Rgba> pixels(32 * 16, Imf::Rgba(half(0.5f), half(0.25f), half(0.125f)));
    {
        Imf::RgbaOutputFile file((folder / "yc.exr").c_str(), 32, 16, Imf::WRITE_YCA);
        file.setFrameBuffer(pixels.data(), 1, 32);
        file.writePixels(16);
    }
    Imf::InputFile plain((folder / "yc.exr").c_str());
    Imf::Header header(32, 16);
    std::vector<half> values[4];
    const char* names[] = {"Y", "RY", "BY", "A"};
    Imf::FrameBuffer in, out;
    for (int i = 0; i < 4; ++i) {
        const int step = i == 1 || i == 2 ? 2 : 1, width = 32 / step;
        values[i].resize(static_cast<std::size_t>(width * 16 / step));
        const Imf::Slice slice(Imf::HALF, reinterpret_cast<char*>(values[i].data()), sizeof(half),
                               sizeof(half) * static_cast<std::size_t>(width), step, step);
        in.insert(names[i], slice);
        out.insert(std::string("beauty.") + names[i], slice);
        header.channels().insert(std::string("beauty.") + names[i], Imf::Channel(Imf::HALF, step, step));
    }
    plain.setFrameBuffer(in);
    plain.readPixels(0, 15);
    {
        Imf::OutputFile file((folder / "layer.exr").c_str(), header);
        file.setFrameBuffer(out);
        file.writePixels(16);
    }
    const ImageData expected = readExr(folder / "yc.exr"), read = readExr(folder / "layer.exr");
    EXPECT_EQ(read.channels, 4);
    EXPECT_TRUE(read.hasOpacity);
    EXPECT_EQ(read.values, expected.values);
}

// If this fails, a study that was stopped while writing goes on with half an image.
TEST_F(Images, ExrCutAnywhereIsRefused) {
    writeExr(folder / "a.exr", noise(20, 40, 3));
    const std::string whole = readText(folder / "a.exr");
    const Path path = folder / "cut.exr";
    for (std::size_t length = 0; length < whole.size(); length += 1 + length / 50) {
        writeFile(path, std::string_view(whole).substr(0, length));
        const std::string text = refusal([&] { readExr(path); });
        EXPECT_EQ(text.find(path.string() + ": is "), 0u) << length << " of " << whole.size() << " bytes: " << text;
    }
}

TEST_F(Images, ExrWithAFlippedByteIsRefusedOrReadButNeverFatal) {
    writeExr(folder / "a.exr", noise(16, 16, 1));
    const std::string whole = readText(folder / "a.exr");
    int refused = 0;
    for (std::size_t i = 0; i < whole.size(); i += i < 400 ? 1 : 7) {
        for (const unsigned char mask : {0x01, 0x80}) {
            std::string damaged = whole;
            damaged[i] = static_cast<char>(damaged[i] ^ mask);
            writeFile(folder / "d.exr", damaged);
            refused += refusal([&] { readExr(folder / "d.exr"); }).empty() ? 0 : 1;
        }
    }
    EXPECT_GT(refused, 100);
}

TEST_F(Images, ExrOfAbsurdSizeIsRefusedBeforeMemoryIsTaken) {
    writeExr(folder / "a.exr", noise(16, 16, 1));
    std::string content = readText(folder / "a.exr");
    const std::string_view name("dataWindow\0box2i\0", 17);
    const std::size_t at = content.find(name) + name.size() + 4 + 8;  // after the size, xMin and yMin
    content.replace(at, 4, std::string("\xFF\xFF\xFF\x3F", 4));
    writeFile(folder / "b.exr", content);
    EXPECT_NE(refusal([&] { readExr(folder / "b.exr"); }), "");
    EXPECT_NE(refusal([&] { checkImageSize("f", 1 << 16, 1 << 16, 3); }).find("65536 x 65536"), std::string::npos);
    EXPECT_EQ(refusal([&] { checkImageSize("f", 16384, 8192, 4); }), "");
    EXPECT_NE(refusal([&] { checkImageSize("f", 0, 8, 4); }), "");
}

// OpenEXR would take the memory first: found by the fuzzer, as an attribute of 1.9 GB in a file of a kilobyte.
TEST_F(Images, ExrWithAnAttributeOfAbsurdSizeIsRefused) {
    writeExr(folder / "a.exr", noise(4, 3, 3), {.attributes = {{"note", "abcd"}}});
    const std::string whole = readText(folder / "a.exr");
    const auto tell = [&](std::string_view before, std::string_view value) {
        std::string damaged = whole;
        damaged.replace(damaged.find(before) + before.size(), value.size(), value);
        writeFile(folder / "d.exr", damaged);
        return refusal([&] { readExr(folder / "d.exr"); });
    };
    using namespace std::string_view_literals;
    EXPECT_NE(tell("note\0string\0"sv, "\0\0\0\x70"sv).find("its attribute \"note\" leaves the file"), std::string::npos);
    EXPECT_NE(tell("lineOrder\0lineOrder\0"sv, "\x02"sv).find("its attribute \"lineOrder\" has a wrong size"), std::string::npos);
    EXPECT_NE(tell("channels\0chlist\0"sv, "\x20"sv).find("its attribute \"channels\" has a wrong size"), std::string::npos);
    const auto tellOf = [&](std::string_view type, std::string_view value) {
        std::string file("\x76\x2f\x31\x01\x02\0\0\0any\0"sv);
        file += std::string(type) + '\0' + static_cast<char>(value.size()) + std::string(3, '\0') + std::string(value);
        writeFile(folder / "d.exr", file);
        return refusal([&] { readExr(folder / "d.exr"); });
    };
    for (const auto& [type, value] :
         {std::pair("stringvector"sv, "\0\0\0\x70"sv), {"preview"sv, "\0\x40\0\0\0\x40\0\0"sv}, {"m44f"sv, "1"sv}})
        EXPECT_NE(tellOf(type, value).find("its attribute \"any\" has a wrong size"), std::string::npos)
            << type << ": " << tellOf(type, value);
    EXPECT_NE(tellOf("stringvector", "\1\0\0\0a"sv).find("it ends too early"), std::string::npos)
        << "this one is whole, what follows isn't there";
}

// Files far smaller than what they claim are read on trial first. If this fails, that trial spoils or refuses images that are only smooth.
TEST_F(Images, ExrOfFewBytesKeepsItsPixels) {
    ImageData smooth = makeImage(2048, 600, 2);
    for (int y = 0; y < smooth.height; ++y) smooth.at(7, y, 1) = static_cast<float>(y);
    writeExr(folder / "smooth.exr", smooth);
    ASSERT_LT(fs::file_size(folder / "smooth.exr") * 64, smooth.values.size()) << "no test: it is not smooth enough";
    EXPECT_TRUE(readExr(folder / "smooth.exr").values == smooth.values);

    std::vector<Imf::Rgba> pixels(2048 * 600, Imf::Rgba(half(0.5f), half(0.25f), half(0.125f)));
    {
        Imf::RgbaOutputFile file((folder / "yc.exr").c_str(), 2048, 600, Imf::WRITE_YC);
        file.setFrameBuffer(pixels.data(), 1, 2048);
        file.writePixels(600);
    }
    const ImageData colors = readExr(folder / "yc.exr");
    ASSERT_EQ(colors.pixelCount(), pixels.size());
    EXPECT_NEAR(colors.at(2047, 599, 1), 0.25, 0.005);
}

// OpenEXR holds many lines, or a row of tiles, before it looks at the first pixel.
TEST_F(Images, ExrOfAbsurdLinesOrTilesIsRefused) {
    Imf::Header wide(60000, 1);
    for (int i = 0; i < 60; ++i) wide.channels().insert("c" + std::to_string(i), Imf::Channel(Imf::FLOAT));
    { const Imf::OutputFile file((folder / "wide.exr").c_str(), wide); }
    EXPECT_NE(refusal([&] { readExr(folder / "wide.exr"); }).find("lines of 14400000 bytes"), std::string::npos);
    Imf::Header tiled(16, 16);
    for (const char* name : {"R", "G", "B"}) tiled.channels().insert(name, Imf::Channel(Imf::FLOAT));
    tiled.setTileDescription(Imf::TileDescription(8192, 8192));
    { const Imf::TiledOutputFile file((folder / "tiled.exr").c_str(), tiled); }
    EXPECT_NE(refusal([&] { readExr(folder / "tiled.exr"); }).find("tiles of 8192 x 8192"), std::string::npos);
}

TEST_F(Images, ForeignFilesAreNamed) {
    const auto tell = [&](const char* name, std::string_view content) {
        writeFile(folder / name, content);
        return refusal([&] { readImage(folder / name); }).substr((folder / name).string().size() + 2);
    };
    EXPECT_EQ(tell("a.exr", "hello"), "is not an image that this program reads; known: OpenEXR (.exr), PNG (.png), JPEG (.jpg), Radiance (.hdr)");
    EXPECT_EQ(tell("empty.png", ""), "is not an image that this program reads; known: OpenEXR (.exr), PNG (.png), JPEG (.jpg), Radiance (.hdr)");
    EXPECT_EQ(tell("p.hdr", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n"),
              "is a git-lfs pointer, not the file itself; fetch with git lfs pull");
    EXPECT_EQ(refusal([&] { readImage(folder / "none.exr"); }),
              (folder / "none.exr").string() + ": cannot be read: No such file or directory");
    EXPECT_EQ(refusal([&] { readExr(folder / "a.exr"); }), (folder / "a.exr").string() + ": is not an OpenEXR file");
    EXPECT_EQ(refusal([&] { readPng(folder / "a.exr"); }), (folder / "a.exr").string() + ": is not a PNG file");
    EXPECT_EQ(refusal([&] { readHdr(folder / "a.exr"); }), (folder / "a.exr").string() + ": is not a Radiance .hdr file");
    EXPECT_NE(refusal([&] { writeImage(folder / "a.jpg", makeImage(1, 1, 3)); }), "");
}

TEST_F(Images, KindIsToldByContentAndNotByName) {
    writePng(folder / "a.png", makeImage(3, 2, 3));
    fs::rename(folder / "a.png", folder / "a.exr");
    EXPECT_EQ(readImage(folder / "a.exr").width, 3);
}

// Files that once made image readers crash, hang or take all memory.
TEST(ExrSamples, DamagedFilesAreRefused) {
    const Path folder = assets("exr/Damaged");
    NEED_ASSETS(folder);
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!entry.is_regular_file() || entry.path().extension() == ".rst") continue;
        ++files;
        EXPECT_NE(refusal([&] { readExr(entry.path()); }), "") << entry.path();
    }
    EXPECT_GT(files, 50);
}

// 16 files of the same 400 x 300 pixels in different windows.
TEST(ExrSamples, DisplayWindowsShowTheRightPixels) {
    const Path folder = assets("exr/DisplayWindow");
    NEED_ASSETS(folder);
    const ImageData all = readExr(folder / "t01.exr");
    ASSERT_EQ(all.width, 400);
    ASSERT_EQ(all.height, 300);
    for (int i = 2; i <= 16; ++i) {
        const Path path = folder / ("t" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".exr");
        const ImageData image = readExr(path);
        const Imf::InputFile file(path.c_str());
        const Imath::Box2i display = file.header().displayWindow(), data = file.header().dataWindow();
        ASSERT_EQ(image.width, display.max.x - display.min.x + 1) << path;
        ASSERT_EQ(image.height, display.max.y - display.min.y + 1) << path;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const Imath::V2i at = Imath::V2i(x, y) + display.min;
                for (int c = 0; c < 3; ++c) {
                    const float expected = data.intersects(at) ? all.at(at.x - data.min.x, at.y - data.min.y, c) : 0;
                    ASSERT_EQ(image.at(x, y, c), expected) << path << " " << x << ", " << y;
                }
            }
        }
    }
}

TEST(ExrSamples, KindsOfFiles) {
    NEED_ASSETS(assets("exr/ScanLines"));
    EXPECT_EQ(readExrFile(assets("exr/LuminanceChroma/Garden.exr")).channels, std::vector<std::string>{"Y"});
    EXPECT_GT(readExr(assets("exr/MultiResolution/WavyLinesSphere.exr")).width, 100);
    EXPECT_GT(readExr(assets("exr/ScanLines/Carrots.exr")).width, 100);
    const ImageData halves = readExr(assets("exr/TestImages/AllHalfValues.exr"));
    EXPECT_EQ(halves.pixelCount(), 65536u);
}

// ---- PNG

TEST(Srgb, IsWhatTheStandardSays) {
    EXPECT_NEAR(encodeSrgb(0.5f), 0.7353569, 1e-6);
    EXPECT_NEAR(decodeSrgb(0.5f), 0.2140411, 1e-6);
    EXPECT_NEAR(encodeSrgb(0.002f), 0.02584, 1e-7);
    EXPECT_FLOAT_EQ(encodeSrgb(1), 1);
}

TEST_F(Images, PngKeepsEveryOneOfItsLevels) {
    for (const int channels : {1, 3, 4}) {
        ImageData image = makeImage(256, channels, channels);
        for (std::size_t i = 0; i < image.values.size(); ++i) {
            const float encoded = static_cast<float>(i % 256) / 255;
            image.values[i] = channels == 4 && i % 4 == 3 ? encoded : decodeSrgb(encoded);
        }
        writePng(folder / "a.png", image);
        expectSame(readPng(folder / "a.png"), image);
    }
}

TEST_F(Images, PngClampsAndRounds) {
    ImageData image = makeImage(7, 1, 1);
    image.values = {-1, 0.18f, 0.5f, 1, 1000, std::nanf(""), std::numeric_limits<float>::infinity()};
    writePng(folder / "a.png", image);
    const ImageData read = readPng(folder / "a.png");
    const float levels[] = {0, 118, 188, 255, 255, 0, 255};
    for (int x = 0; x < 7; ++x) EXPECT_EQ(read.at(x, 0, 0), decodeSrgb(levels[x] / 255)) << x;
    EXPECT_NE(refusal([&] { writePng(folder / "a.png", makeImage(1, 1, 2)); }), "");
}

TEST_F(Images, PngReadsSixteenBits) {
    // 1 x 1 pixel of grey 0x8001, 16 bits: made with Python's zlib.
    const unsigned char bytes[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
                                   0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x10, 0x00, 0x00, 0x00, 0x00, 0x6a, 0xee, 0x47, 0x16, 0x00,
                                   0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0x60, 0x04, 0x00, 0x01, 0x04, 0x00,
                                   0x82, 0x39, 0x9b, 0xc0, 0xba, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    writeFile(folder / "a.png", std::as_bytes(std::span(bytes)));
    const ImageData image = readPng(folder / "a.png");
    ASSERT_EQ(image.channels, 1);
    EXPECT_FLOAT_EQ(image.at(0, 0, 0), decodeSrgb(32769.0f / 65535.0f));
}

// Every kind of PNG but interlaced ones, by hand.
TEST_F(Images, PngOfEveryKindHasItsValues) {
    const auto read = [&](std::vector<std::pair<std::string, std::string>> chunks) {
        writeFile(folder / "a.png", pngFile(std::move(chunks)));
        return readPng(folder / "a.png");
    };
    const auto linear = [](int value, int top) { return decodeSrgb(static_cast<float>(value) / static_cast<float>(top)); };
    const auto zeros = [](std::initializer_list<unsigned> bytes) { return std::string(bytes.begin(), bytes.end()); };

    ImageData image = read({{"IHDR", pngHeader(1, 8, 4)}, {"IDAT", stored(zeros({0, 51, 102}))}});
    EXPECT_EQ(image.values, (std::vector<float>{linear(51, 255), 0.4f})) << "grey and opacity";
    EXPECT_TRUE(image.hasOpacity);
    image = read({{"IHDR", pngHeader(1, 16, 2)}, {"IDAT", stored(zeros({0, 1, 2, 3, 4, 5, 6}))}});
    EXPECT_EQ(image.values, (std::vector<float>{linear(0x102, 65535), linear(0x304, 65535), linear(0x506, 65535)}));
    EXPECT_FALSE(image.hasOpacity);
    image = read({{"IHDR", pngHeader(1, 16, 6)}, {"IDAT", stored(zeros({0, 1, 2, 3, 4, 5, 6, 7, 8}))}});
    EXPECT_EQ(image.values, (std::vector<float>{linear(0x102, 65535), linear(0x304, 65535), linear(0x506, 65535), 0x708 / 65535.0f}));
    image = read({{"IHDR", pngHeader(2, 4, 3)}, {"PLTE", zeros({10, 20, 30, 40, 50, 60})}, {"IDAT", stored(zeros({0, 0x10}))}});
    EXPECT_EQ(image.values,
              (std::vector<float>{linear(40, 255), linear(50, 255), linear(60, 255), linear(10, 255), linear(20, 255), linear(30, 255)}))
        << "a palette";
    EXPECT_FALSE(image.hasOpacity);
    image = read({{"IHDR", pngHeader(2, 8, 3)},
                  {"PLTE", zeros({10, 20, 30, 40, 50, 60})},
                  {"tRNS", zeros({51})},
                  {"IDAT", stored(zeros({0, 0, 1}))}});
    ASSERT_EQ(image.channels, 4) << "a palette with opacities";
    EXPECT_TRUE(image.hasOpacity);
    EXPECT_EQ(image.at(0, 0, 3), 0.2f);
    EXPECT_EQ(image.at(1, 0, 3), 1);
    image = read({{"IHDR", pngHeader(2, 8, 0)}, {"tRNS", zeros({0, 51})}, {"IDAT", stored(zeros({0, 51, 102}))}});
    EXPECT_EQ(image.values, (std::vector<float>{linear(51, 255), 0, linear(102, 255), 1})) << "a grey that is transparent";
    image = read({{"IHDR", pngHeader(8, 1, 0)}, {"IDAT", stored(zeros({0, 0xA0}))}});
    EXPECT_EQ(image.values, (std::vector<float>{1, 0, 1, 0, 0, 0, 0, 0})) << "bits";
}

TEST_F(Images, PngWithAnotherCurveSaysSo) {
    const auto tell = [&](std::uint32_t gamma, bool srgb) {
        std::string word;
        for (int shift = 24; shift >= 0; shift -= 8) word += static_cast<char>(gamma >> shift);
        std::vector<std::pair<std::string, std::string>> chunks{{"IHDR", pngHeader(1, 8, 0)}, {"gAMA", word}};
        if (srgb) chunks.emplace_back("sRGB", std::string(1, 0));
        chunks.emplace_back("IDAT", stored({0, 51}));
        writeFile(folder / "a.png", pngFile(std::move(chunks)));
        testing::internal::CaptureStderr();
        EXPECT_EQ(readPng(folder / "a.png").at(0, 0, 0), decodeSrgb(0.2f));
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(tell(45455, false), "");
    EXPECT_NE(tell(100000, false).find("encoded with the exponent 1;"), std::string::npos);
    EXPECT_EQ(tell(100000, true), "") << "sRGB overrules it";
}

// If this fails, a damaged image is compared as if it were whole.
TEST_F(Images, PngCutOrFlippedAnywhereIsRefused) {
    writePng(folder / "a.png", noise(9, 7, 3));
    const std::string whole = readText(folder / "a.png");
    for (std::size_t i = 0; i < whole.size(); ++i) {
        writeFile(folder / "cut.png", std::string_view(whole).substr(0, i));
        EXPECT_NE(refusal([&] { readPng(folder / "cut.png"); }), "") << "cut to " << i << " of " << whole.size() << " bytes";
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x04);
        writeFile(folder / "flip.png", damaged);
        EXPECT_NE(refusal([&] { readPng(folder / "flip.png"); }), "") << "flipped at " << i;
    }
}

// ---- Radiance

std::string hdrFile(const std::string& resolution, const std::string& pixels) {
    return "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n" + pixels;
}

TEST_F(Images, HdrPixelsHaveTheirValues) {
    const auto read = [&](const std::string& content) {
        writeFile(folder / "a.hdr", content);
        return readImage(folder / "a.hdr").values;
    };
    // 128 x 2^(129 - 136) = 1; exponent 0 is black.
    const std::string one("\x80\x40\x20\x81", 4), black("\x09\x09\x09\x00", 4);
    EXPECT_EQ(read(hdrFile("-Y 2 +X 1", one + black)), (std::vector<float>{1, 0.5f, 0.25f, 0, 0, 0}));
    EXPECT_EQ(read(hdrFile("+Y 2 +X 1", one + black)), (std::vector<float>{0, 0, 0, 1, 0.5f, 0.25f})) << "bottom line first";
    const auto repeated = [](int count) {
        std::vector<float> values;
        for (int i = 0; i < count; ++i) values.insert(values.end(), {1, 0.5f, 0.25f});
        return values;
    };
    EXPECT_EQ(read(hdrFile("-Y 1 +X 4", one + std::string("\x01\x01\x01\x03", 4))), repeated(4)) << "older run lengths";
    EXPECT_EQ(read(hdrFile("-Y 1 +X 260", one + std::string("\x01\x01\x01\x03\x01\x01\x01\x01", 8))), repeated(260))
        << "3 + 256 x 1 repeats";
    const std::string runs("\x02\x02\x00\x08\x88\x80\x88\x40\x88\x20\x08\x81\x81\x81\x81\x81\x81\x81\x81", 19);
    EXPECT_EQ(read(hdrFile("-Y 1 +X 8", runs)), repeated(8)) << "runs and a literal sequence by component";
}

// If this fails, the same picture has two brightnesses (Radiance, File Formats, "Picture": such lines add up).
TEST_F(Images, HdrExposureIsUndone) {
    std::string said;
    const auto read = [&](const std::string& lines) {
        writeFile(folder / "a.hdr", "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x81");
        testing::internal::CaptureStderr();
        std::vector<float> values = readImage(folder / "a.hdr").values;
        said = testing::internal::GetCapturedStderr();
        return values;
    };
    EXPECT_EQ(read(""), (std::vector<float>{1, 0.5f, 0.25f}));
    EXPECT_EQ(read("EXPOSURE=1\n"), (std::vector<float>{1, 0.5f, 0.25f}));
    EXPECT_EQ(read("EXPOSURE=5.0e-1\n"), (std::vector<float>{2, 1, 0.5f}));
    EXPECT_EQ(read("EXPOSURE=  0.5\nSOFTWARE=x\nEXPOSURE=0.25\n"), (std::vector<float>{8, 4, 2}));
    EXPECT_EQ(read("COLORCORR=0.5 1 2\nEXPOSURE=0.5\r\n"), (std::vector<float>{4, 1, 0.25f}));
    EXPECT_EQ(read("\tEXPOSURE=0.5\n# EXPOSURE=0.5\n"), (std::vector<float>{1, 0.5f, 0.25f})) << "of another picture; a comment";
    EXPECT_EQ(said, "");
    EXPECT_EQ(read("PIXASPECT=1.0\nPRIMARIES=0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333\nGAMMA=1\n").size(), 3u);
    EXPECT_EQ(said, "");
    for (const char* odd : {"EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=nan", "EXPOSURE=bright", "EXPOSURE=1e300", "COLORCORR=1 1",
                            "PIXASPECT=1.5", "PRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.329", "GAMMA=2.2"}) {
        EXPECT_EQ(read(odd + std::string("\n")), (std::vector<float>{1, 0.5f, 0.25f})) << odd;
        EXPECT_NE(said.find(odd), std::string::npos) << odd << ": " << said;
    }
}

TEST_F(Images, HdrOfEachOrientationStandsUpright) {
    // The pixels a b / c d / e f as a file of each orientation has them.
    const std::pair<const char*, const char*> files[] = {{"-Y 3 +X 2", "abcdef"}, {"+Y 3 +X 2", "efcdab"}, {"-Y 3 -X 2", "badcfe"},
                                                         {"+Y 3 -X 2", "fedcba"}, {"+X 2 -Y 3", "acebdf"}, {"-X 2 -Y 3", "bdface"},
                                                         {"+X 2 +Y 3", "ecafdb"}, {"-X 2 +Y 3", "fdbeca"}};
    for (const auto& [resolution, order] : files) {
        std::string pixels;
        for (const char* c = order; *c; ++c) pixels += {*c, *c, *c, '\x88'};
        writeFile(folder / "a.hdr", hdrFile(resolution, pixels));
        const ImageData image = readImage(folder / "a.hdr");
        ASSERT_EQ(image.width, 2) << resolution;
        ASSERT_EQ(image.height, 3) << resolution;
        std::string found;
        for (std::size_t i = 0; i < image.values.size(); i += 3) found += static_cast<char>(image.values[i]);
        EXPECT_EQ(found, "abcdef") << resolution;
    }
}

TEST_F(Images, HdrCutOrDamagedIsRefused) {
    const auto tell = [&](const std::string& content) {
        writeFile(folder / "a.hdr", content);
        return refusal([&] { readHdr(folder / "a.hdr"); });
    };
    const std::string start("\x02\x02\x00\x08", 4), whole = hdrFile("-Y 1 +X 8", start + "\x88\x80\x88\x40\x88\x20\x88\x81");
    EXPECT_EQ(tell(whole), "");
    for (std::size_t length = 0; length < whole.size(); ++length) EXPECT_NE(tell(whole.substr(0, length)), "") << length;
    EXPECT_NE(tell(hdrFile("-Y 1 +X 8", start + "\x89\x80\x88\x40\x88\x20\x88\x81")).find("does not fit"), std::string::npos);
    EXPECT_NE(tell(hdrFile("-Y 1 +X 8", start + std::string(200, '\0'))).find("does not fit"), std::string::npos)
        << "a run of nothing never ends";
    EXPECT_NE(tell(hdrFile("-Y 1 +X 2", std::string("\x01\x01\x01\x01", 4))).find("does not fit"), std::string::npos)
        << "nothing to repeat";
    EXPECT_NE(tell(hdrFile("-Y 60000 +X 60000", "1234")).find("60000 x 60000"), std::string::npos);
    EXPECT_NE(tell(hdrFile("-Y 30000 +X 4000", "1234")), "");
    for (const char* resolution : {"+X 1 -X 1", "-Y 1", "-Y 1 +Z 1", "Y 1 X 1"})
        EXPECT_NE(tell(hdrFile(resolution, "1234")).find("resolution"), std::string::npos) << resolution;
    EXPECT_NE(tell("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234").find("xyze"), std::string::npos);
}

// stb is an independent reader of whole files.
TEST(HdrSamples, AgreeWithAnotherReader) {
    const Path folder = assets("env");
    NEED_ASSETS(folder);
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".hdr") continue;
        const ImageData image = readImage(entry.path());
        int width = 0, height = 0, channels = 0;
        float* other = stbi_loadf(entry.path().c_str(), &width, &height, &channels, 3);
        ASSERT_NE(other, nullptr);
        ASSERT_EQ(image.width, width);
        ASSERT_EQ(image.height, height);
        EXPECT_TRUE(std::equal(image.values.begin(), image.values.end(), other)) << entry.path();
        stbi_image_free(other);
    }
}

// ---- Colours of error maps

// If this fails, a larger error may look smaller.
TEST(ColorMap, GrowsLighterAllTheWay) {
    ImageData ramp = makeImage(256, 1, 1);
    for (int x = 0; x < 256; ++x) ramp.at(x, 0, 0) = static_cast<float>(x) / 255 * 3;
    const ImageData colors = colorMap(ramp, 3);
    double last = -1;
    for (int x = 0; x < 256; ++x) {
        const double luminance = 0.2126 * static_cast<double>(colors.at(x, 0, 0)) + 0.7152 * static_cast<double>(colors.at(x, 0, 1)) +
                                 0.0722 * static_cast<double>(colors.at(x, 0, 2));
        const double lightness = luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;
        EXPECT_GT(lightness, last) << x;
        EXPECT_LT(lightness - last, 1.6) << x;  // no visible edge that the errors don't have; even steps would be 0.4
        last = lightness;
    }
    EXPECT_GT(last, 95);
    ImageData odd = makeImage(4, 1, 1);
    odd.values = {-1, 10, std::nanf(""), 0};
    const ImageData shown = colorMap(odd, 3);
    EXPECT_EQ(shown.at(0, 0, 1), shown.at(3, 0, 1));
    EXPECT_EQ(shown.at(1, 0, 0), colors.at(255, 0, 0));
    EXPECT_EQ(shown.at(2, 0, 0), 0);
    EXPECT_EQ(shown.at(2, 0, 1), 1);
}

TEST(ImageData, FirstChannels) {
    const ImageData image{2, 1, 4, {1, 2, 3, 4, 5, 6, 7, 8}};
    EXPECT_EQ(firstChannels(image, 3).values, (std::vector<float>{1, 2, 3, 5, 6, 7}));
    EXPECT_EQ(firstChannels(image, 4).values, image.values);
}

}  // namespace
}  // namespace lodestir
