// SPDX-License-Identifier: MIT
// JPEG files: the picture that went in comes out, and damaged ones are refused.
#include "../temporary_folder.h"

#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/image_file.h>
#include <framework/image/srgb.h>

#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <cstdlib>
#include <random>

namespace lodestir {
namespace {

class Jpeg : public test::FolderTest {
protected:
    /// A picture of one colour, 8 bits a channel.
    static std::string encoded(int width, int height, int channels, const std::vector<unsigned char>& pixel) {
        std::vector<unsigned char> texels;
        for (int i = 0; i < width * height; ++i) texels.insert(texels.end(), pixel.begin(), pixel.end());
        std::string bytes;
        const auto append = [](void* to, void* data, int size) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(data), std::size_t(size));
        };
        EXPECT_NE(stbi_write_jpg_to_func(append, &bytes, width, height, channels, texels.data(), 95), 0);
        return bytes;
    }
};

TEST_F(Jpeg, IsReadAsLinearLight) {
    writeFile(folder / "picture.anything", encoded(20, 9, 3, {200, 100, 50}));
    EXPECT_TRUE(isDisplayed(folder / "picture.anything"));
    const ImageData image = readImage(folder / "picture.anything");
    EXPECT_EQ(image.width, 20);
    EXPECT_EQ(image.height, 9);
    ASSERT_EQ(image.channels, 3);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(13, 4, c), decodeSrgb(std::array{200, 100, 50}[std::size_t(c)] / 255.0f), 0.02f);

    writeImage(folder / "light.exr", image);
    EXPECT_FALSE(isDisplayed(folder / "light.exr"));
    EXPECT_FALSE(isDisplayed(folder / "nothing"));
}

// If this fails, a file from elsewhere ends the program, or takes all memory.
TEST_F(Jpeg, DamagedFilesAreRefused) {
    const std::string good = encoded(64, 64, 3, {90, 90, 90});
    const auto refused = [&](const std::string& bytes) {
        writeFile(folder / "x.jpg", bytes);
        try {
            readImage(folder / "x.jpg");
            return std::string();
        } catch (const Error& error) {
            return std::string(error.what());
        }
    };
    EXPECT_NE(refused(good.substr(0, 40)).find("x.jpg: is damaged or cut"), std::string::npos);
    EXPECT_NE(refused("\xff\xd8").find("is damaged or cut"), std::string::npos);
    std::string huge = good;  // the frame header's height and width
    const std::size_t frame = huge.find("\xff\xc0");
    ASSERT_NE(frame, huge.npos);
    for (std::size_t i = 5; i < 9; ++i) huge[frame + i] = '\x7f';
    EXPECT_NE(refused(huge).find("x.jpg: "), std::string::npos);

    std::mt19937 random(5);
    for (int trial = 0; trial < 300; ++trial) {
        std::string bytes = good;
        for (int i = 0; i < 4; ++i) bytes[random() % bytes.size()] = char(random());
        refused(bytes.substr(0, trial % 3 == 0 ? random() % bytes.size() : bytes.size()));  // whatever it says, it ends
    }
}

}  // namespace
}  // namespace lodestir
