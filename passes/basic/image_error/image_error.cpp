// SPDX-License-Identifier: MIT
// The error of each pixel against another image, while it is rendered. Its mean is the metric of the same name of `lodestir compare`.
// FLIP is not among them: its filters and exposures would be many passes, so it is left to `compare --map`.
#include <framework/pass/pass.h>

using namespace lodestir;

enum class Metric { mse, mae, relmse, mape, smape };

struct ImageError final : Pass {
    In<Image>     test{this, "test", "image to judge, linear"};
    In<Image>     reference{this, "reference", "image to judge it by, of the same size"};
    Out<Image>    error{this, "error", "error of each pixel, the mean over red, green and blue", Format::r32f, {.like = "test"}};
    Out<Image>    colors{this, "colors",
                         "the same from black over purple and orange to pale yellow, display-linear; green where it is no number",
                         Format::rgba32f, {.like = "test"}};
    Param<Metric> metric{this, "metric", Metric::relmse, {"mse", "mae", "relmse", "mape", "smape"},
                         "as `lodestir compare` defines them, with x the test image and r the reference: (x - r)^2, |x - r|, "
                         "(x - r)^2 / (mean(r)^2 + 0.01), 100 |x - r| / (|r| + 0.01), |x - r| / (|x| + |r| + 0.01)"};
    Param<float>  exposure{this, "exposure", 1.0f, {0, 1e6f},
                           "factor on both images before 0.01 is added, as compare's --exposure (which else makes the median luminance of "
                           "the reference 0.18)"};
    Param<float>  top{this, "top", 1.0f, {0, 1e6f}, "the error shown brightest"};

    void execute(Frame& frame) override {
        if (frame.sizeOf(test) != frame.sizeOf(reference)) throw Error("an image_error compares two images of different sizes");
        frame.dispatch(shader, frame.sizeOf(error));
    }
};
LODESTIR_PASS(ImageError, "image_error.comp",
              "Shows how far each pixel is from a reference. FLIP and other metrics that look around a pixel are left to `lodestir "
              "compare --map`.")
