// SPDX-License-Identifier: MIT
// What editors and the docs say about passes must be what the passes declare.
#include "fake_passes.h"

#include <framework/graph/schema.h>

#include <gtest/gtest.h>

namespace lodestir {
namespace {

std::vector<PassType> types() {
    std::vector<PassType> all;
    all.push_back(makePassType("blur", fake::plugin<fake::Blur>("Blur")));
    all.push_back(makePassType("lod_select", fake::plugin<fake::LodSelect>("LodSelect")));
    all.push_back(makePassType("render", fake::plugin<fake::Render>("Render")));
    all.push_back(makePassType("bake", fake::plugin<fake::Bake>("Bake")));
    all.push_back(makePassType("drift", fake::plugin<fake::Drift>("Drift")));
    all.push_back(makePassType("follow", fake::plugin<fake::Follow>("Follow")));
    return all;
}

TEST(Schema, HasARuleForEachPass) {
    const std::vector<PassType> all = types();
    const Json schema = graphSchema(all);
    EXPECT_EQ(schema.find("$schema")->asString(), "https://json-schema.org/draft/2020-12/schema");
    const Json& rules = *schema.find("$defs")->find("pass")->find("allOf");
    ASSERT_EQ(rules.items().size(), 6u);
    const Json& blur = *rules.items()[0].find("then");
    EXPECT_EQ(rules.items()[0].find("if")->find("properties")->find("type")->find("const")->asString(), "blur");
    const Json& in = *blur.find("properties")->find("in");
    EXPECT_FALSE(in.find("additionalProperties")->asBool());
    EXPECT_EQ(in.find("required")->dump(-1), "[\"color\"]");  // the mask is optional
    EXPECT_NE(in.find("properties")->find("mask"), nullptr);
    const Json& radius = *blur.find("properties")->find("set")->find("properties")->find("radius");
    EXPECT_EQ(radius.find("minimum")->asInt(), 1);
    EXPECT_EQ(radius.find("maximum")->asInt(), 16);
    EXPECT_EQ(radius.find("default")->asInt(), 8);
    EXPECT_EQ(blur.find("properties")->find("off"), nullptr);  // it has a bypass
    const Json& lod = *rules.items()[1].find("then");
    EXPECT_EQ(lod.find("properties")->find("set")->find("properties")->find("mode")->find("enum")->dump(-1),
              "[\"finest\", \"distance\", \"schedule\"]");
    EXPECT_EQ(lod.find("properties")->find("in")->find("required"), nullptr);  // a World finds its source itself
    EXPECT_EQ(rules.items()[5].find("then")->find("properties")->find("in")->find("required"), nullptr);  // so does a struct that one pass makes
    const Json& drift = *rules.items()[4].find("then")->find("properties")->find("in");
    EXPECT_EQ(drift.find("required")->dump(-1), "[\"particles\"]");
    EXPECT_EQ(drift.find("properties")->find("particles")->find("description")->asString(), "Particles: before");
    EXPECT_EQ(drift.find("properties")->find("particles.masses"), nullptr);
    EXPECT_FALSE(rules.items()[2].find("then")->find("properties")->find("off")->find("const")->asBool());
}

TEST(Schema, GivesFacts) {
    const std::vector<PassType> all = types();
    const Json render = facts(all[2]);
    EXPECT_EQ(render.find("doc")->asString(), "A pass of the tests.");
    EXPECT_EQ(render.find("cadence")->asString(), "everyFrame");
    EXPECT_EQ(facts(all[3]).find("cadence")->asString(), "onChange");
    const Json& color = render.find("ports")->items()[1];
    EXPECT_EQ(color.find("name")->asString(), "color");
    EXPECT_EQ(color.find("role")->asString(), "out");
    EXPECT_EQ(color.find("format")->asString(), "rgba16f");
    EXPECT_EQ(render.find("ports")->items()[2].find("size")->asString(), "2 per pixel");
    const Json drift = facts(all[4]), &after = drift.find("ports")->items()[2];
    EXPECT_EQ(after.find("type")->asString(), "Particles");
    EXPECT_EQ(after.find("size")->asString(), "like particles");
    EXPECT_EQ(after.find("bytes"), nullptr);
    ASSERT_EQ(after.find("members")->items().size(), 2u);
    EXPECT_EQ(after.find("members")->items()[1].find("name")->asString(), "particles.masses");
    EXPECT_EQ(after.find("members")->items()[1].find("bytes")->asInt(), 4);
    const Json& gain = render.find("parameters")->items()[0];
    EXPECT_EQ(gain.find("default")->asNumber(), 0.1);
    EXPECT_EQ(gain.find("kind")->asString(), "float");
    EXPECT_TRUE(facts(all[0]).find("parameters")->items()[1].find("constant")->asBool());
}

TEST(Schema, WritesAPage) {
    const std::vector<PassType> all = types();
    const std::string page = markdown(all);
    EXPECT_NE(page.find("\n## blur\n\nA pass of the tests.\n"), std::string::npos) << page;
    EXPECT_NE(page.find("| glow | out | Image | rgba16f, like color | blurred |\n"), std::string::npos) << page;
    EXPECT_NE(page.find("| mask | optional in | Image |  | where to blur |\n"), std::string::npos) << page;
    EXPECT_NE(page.find("| mode | finest \\| distance \\| schedule | \"finest\" | how levels are chosen |\n"), std::string::npos) << page;
    EXPECT_NE(page.find("Off: `glow` is `color`."), std::string::npos) << page;
    EXPECT_NE(page.find("Off: `particles` is `particles`. Particles is places (Buffer<vec4>) and masses (Buffer<float>).\n"), std::string::npos) << page;
    EXPECT_NE(page.find("| past | optional in | Particles |  | last frame's |\n"), std::string::npos) << page;
    EXPECT_NE(text(all[0]).find("  radius  int 1..16            8  half-width, pixels\n"), std::string::npos) << text(all[0]);
}

}  // namespace
}  // namespace lodestir
