// SPDX-License-Identifier: MIT
// The JSON reader's positions, refusals and numbers; access, merge patches and text of values.
#include <framework/core/files.h>
#include <framework/core/json.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace lodestir {
namespace {

std::string place(const Where& where) { return std::to_string(where.line) + ":" + std::to_string(where.column); }

/// The message of parsing `text`, "" when it is right.
std::string refusal(std::string_view text) {
    try {
        Json::parse(text, "f");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

// If this fails, every complaint about a graph or scene file points to the wrong place.
TEST(JsonReader, KnowsThePlaceOfEveryKeyAndValue) {
    const Json root =
        Json::parse("{ \"a\": [1, 22,\n  \"x\" ],\r\n\t\"b\" : { \"\xC3\xA9\xF0\x9F\x98\x80\": true, \"c\":null } }", "f.json");
    EXPECT_EQ(place(root.where()), "1:1");
    EXPECT_EQ(root.where().file, "f.json");
    EXPECT_EQ(root.keyWhere().line, 0);
    const Json& a = *root.find("a");
    EXPECT_EQ(place(a.keyWhere()), "1:3");
    EXPECT_EQ(place(a.where()), "1:8");
    EXPECT_EQ(place(a.items()[0].where()), "1:9");
    EXPECT_EQ(place(a.items()[1].where()), "1:12");
    EXPECT_EQ(place(a.items()[2].where()), "2:3");
    const Json& b = *root.find("b");
    EXPECT_EQ(place(b.keyWhere()), "3:2");  // a tab is one column
    EXPECT_EQ(place(b.where()), "3:8");
    EXPECT_EQ(place(b.members()[0].second.where()), "3:16");  // two code points of six bytes: columns are what editors count
    EXPECT_EQ(place(b.find("c")->keyWhere()), "3:22");
    EXPECT_EQ(place(b.find("c")->where()), "3:26");
}

TEST(JsonReader, SkipsAByteOrderMark) { EXPECT_EQ(place(Json::parse("\xEF\xBB\xBF[7]", "f").items()[0].where()), "1:2"); }

TEST(JsonReader, SyntaxErrorsSayWhereAndWhatWasExpected) {
    EXPECT_EQ(refusal(""), "f:1:1: expected a JSON value, found the end of the file");
    EXPECT_EQ(refusal("{\"a\" 1}"), "f:1:6: expected ':' after the key \"a\", found '1'");
    EXPECT_EQ(refusal("{\"a\": 1 \"b\"}"), "f:1:9: expected ',' or '}' after a member, found '\"'");
    EXPECT_EQ(refusal("{\"a\": }"), "f:1:7: expected a value after ':', found '}'");
    EXPECT_EQ(refusal("{\"a\":1,}"), "f:1:8: expected a key after ',', found '}'; remove the comma before it");
    EXPECT_EQ(refusal("[1,\n ]"), "f:2:2: expected a value after ',', found ']'; remove the comma before it");
    EXPECT_EQ(refusal("[1 2]"), "f:1:4: expected ',' or ']' after an element, found '2'");
    EXPECT_EQ(refusal("[1"), "f:1:3: expected ',' or ']' after an element, found the end of the file");
    EXPECT_EQ(refusal("{a: 1}"), "f:1:2: expected a key in double quotes or '}', found 'a'; keys stand in double quotes");
    EXPECT_EQ(refusal("{} x"), "f:1:4: expected the end of the file after the value, found 'x'");
    EXPECT_EQ(refusal("\"ab\n\""), "f:1:1: expected '\"' at the end of this string, found the end of the line");
    EXPECT_EQ(refusal("[truth]"), "f:1:2: expected a value or ']', found 'truth'");
    EXPECT_EQ(refusal("{\"a\": 1 // one\n}"), "f:1:9: expected ',' or '}' after a member, found '/'; JSON has no comments");
    EXPECT_EQ(refusal("['a']"), "f:1:2: expected a value or ']', found '''; JSON strings stand in double quotes");
    EXPECT_EQ(refusal("[True]"), "f:1:2: expected a value or ']', found 'True'; JSON knows true, false and null");
    EXPECT_EQ(refusal(std::string_view("[\0]", 3)), "f:1:2: expected a value or ']', found a control character (code 0)");
}

// If this fails, a typing slip that repeats a key silently drops one of the two settings.
TEST(JsonReader, ReportsAllKeysGivenTwiceAtTheSecond) {
    EXPECT_EQ(refusal("{\"a\": 1,\n \"a\": 2, \"b\": {\"c\": 1, \"c\": 1}}"),
              "f:2:2: the key \"a\" is given twice; first given at line 1, column 2\n"
              "f:2:24: the key \"c\" is given twice; first given at line 2, column 16");
    EXPECT_NE(refusal("{\"a\": 1, \"\\u0061\": 2}"), "") << "the same key written in two ways";
}

TEST(JsonReader, NumbersFollowTheGrammar) {
    EXPECT_EQ(Json::parse("-0.5e+1", "f").asNumber(), -5.0);
    EXPECT_EQ(Json::parse("9223372036854775807", "f").asInt(), 9223372036854775807ll);
    EXPECT_EQ(Json::parse("-9223372036854775808", "f").asInt(), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(Json::parse("1e3", "f").kind(), Json::Kind::number);
    EXPECT_EQ(Json::parse("1e-400", "f").asNumber(), 0.0);
    EXPECT_EQ(Json::parse("4.9e-324", "f").asNumber(), std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(Json::parse("0.1", "f").asNumber(), 0.1);
    for (const char* wrong : {"01", "1.", ".5", "+1", "-", "1e", "1e+", "0x10", "1.e5", "--1"}) EXPECT_NE(refusal(wrong), "") << wrong;
}

TEST(JsonReader, RefusesNumbersThatDoNotFit) {
    EXPECT_EQ(
        refusal("[9223372036854775808, 1e400]"),
        "f:1:2: expected an integer of 64 bits, found 9223372036854775808; with a decimal point it is read as a floating-point number\n"
        "f:1:23: expected a number that a 64-bit float can hold, found 1e400; the largest is about 1.8e308");
    for (const char* wrong : {"NaN", "[Infinity]", "[-Infinity]"}) {
        EXPECT_NE(refusal(wrong).find("JSON numbers are finite"), std::string::npos) << wrong;
    }
}

TEST(JsonReader, NestingStopsAt128) {
    const auto nested = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
    EXPECT_EQ(refusal(nested(128)), "");
    EXPECT_EQ(refusal(nested(129)), "f:1:129: is nested deeper than 128 levels");
    EXPECT_NE(refusal(std::string(1000000, '[')), "");
    EXPECT_EQ(refusal("[" + std::string(500, ' ') + nested(100) + "," + nested(127) + "]"), "")
        << "depth counts what is open, not what was";
}

TEST(JsonReader, StringsDecodeEscapesAndCheckUtf8) {
    EXPECT_EQ(Json::parse(R"("\"\\\/\b\f\n\r\t\u0041\u00e9\u20AC\ud83d\ude00")", "f").asString(),
              "\"\\/\b\f\n\r\tA\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80");
    EXPECT_EQ(Json::parse("\"a\\u0000b\"", "f").asString().size(), 3u);
    EXPECT_EQ(refusal(R"("\x")").substr(0, 6), "f:1:2:");
    EXPECT_NE(refusal(R"("\u12g4")"), "");
    EXPECT_NE(refusal(R"("\ud83d")"), "");
    EXPECT_NE(refusal(R"("\ud83dA")"), "");
    EXPECT_NE(refusal(R"("\ude00")"), "");
    EXPECT_NE(refusal("\"\t\""), "");
    // Broken, overlong and surrogate sequences, and one beyond U+10FFFF.
    for (const char* wrong : {"\"\xFF\"", "\"\xC3\"", "\"\xC0\xAF\"", "\"\xE0\x80\x80\"", "\"\xED\xA0\x80\"", "\"\xF4\x90\x80\x80\""}) {
        EXPECT_EQ(refusal(wrong), "f:1:2: expected UTF-8 text, found a byte that is not UTF-8; save the file as UTF-8");
    }
}

TEST(Json, CheckedAccessPointsToTheValue) {
    const Json root = Json::parse("{\"n\": 2.5,\n \"whole\": 3.0, \"s\": \"x\", \"big\": 1e300}", "f");
    EXPECT_EQ(root.find("whole")->asInt(), 3);
    EXPECT_EQ(root.find("n")->asNumber(), 2.5);
    const auto message = [](auto call) {
        try {
            call();
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(message([&] { root.find("n")->asInt("spp"); }), "f:1:7: spp must be an integer, not a number (2.5)");
    EXPECT_EQ(message([&] { root.find("big")->asInt("spp"); }), "f:2:33: spp must be an integer, not a number (1e+300)");
    EXPECT_EQ(message([&] { root.find("s")->asNumber("radius"); }), "f:2:21: radius must be a number, not a string (\"x\")");
    EXPECT_EQ(message([&] { root.asBool("off"); }), "f:1:1: off must be true or false, not an object");
    EXPECT_EQ(message([&] { root.items("size"); }), "f:1:1: size must be an array, not an object");
    EXPECT_EQ(root.find("absent"), nullptr);
    EXPECT_EQ(root.find("n")->find("x"), nullptr);
}

TEST(Json, BuildsAndWrites) {
    Json root;
    root["size"].push(960);
    root["size"].push(540);
    root["show"] = Json("display");
    root["exposure"] = Json(1.0);
    root["none"] = Json::object();
    root["passes"]["a"]["in"] = Json();
    EXPECT_EQ(root.dump(),
              "{\n  \"size\": [960, 540],\n  \"show\": \"display\",\n  \"exposure\": 1.0,\n  \"none\": {},\n"
              "  \"passes\": {\n    \"a\": {\n      \"in\": null\n    }\n  }\n}");
    EXPECT_EQ(root.dump(-1), R"({"size": [960, 540], "show": "display", "exposure": 1.0, "none": {}, "passes": {"a": {"in": null}}})");
    EXPECT_EQ(Json::parse(root.dump(), "f").dump(), root.dump());
    EXPECT_EQ(Json(std::nan("")).dump(), "null");
    EXPECT_EQ(Json(0.1).dump(), "0.1");
    EXPECT_TRUE(root.remove("size"));
    EXPECT_FALSE(root.remove("size"));
    EXPECT_THROW(root["show"]["x"], Error);
    EXPECT_THROW(root.push(1), Error);
}

TEST(Json, ConvertsToAndFromNlohmann) {
    const auto plain = nlohmann::ordered_json::parse(R"({"z": [1, -2, 2.5, true, null, "s"], "a": {}})");
    EXPECT_EQ(Json::from(plain).plain().dump(), plain.dump());
    EXPECT_EQ(Json::from(plain).members()[0].first, "z") << "members keep their order";
    EXPECT_THROW(Json::from(nlohmann::ordered_json(~std::uint64_t{0})), Error);
}

// The table of examples in RFC 7396, appendix A.
TEST(Json, MergePatchDoesWhatTheRfcSays) {
    const struct {
        const char *original, *patch, *result;
    } rows[] = {{R"({"a":"b"})", R"({"a":"c"})", R"({"a":"c"})"},
                {R"({"a":"b"})", R"({"b":"c"})", R"({"a":"b","b":"c"})"},
                {R"({"a":"b"})", R"({"a":null})", R"({})"},
                {R"({"a":"b","b":"c"})", R"({"a":null})", R"({"b":"c"})"},
                {R"({"a":["b"]})", R"({"a":"c"})", R"({"a":"c"})"},
                {R"({"a":"c"})", R"({"a":["b"]})", R"({"a":["b"]})"},
                {R"({"a":{"b":"c"}})", R"({"a":{"b":"d","c":null}})", R"({"a":{"b":"d"}})"},
                {R"({"a":[{"b":"c"}]})", R"({"a":[1]})", R"({"a":[1]})"},
                {R"(["a","b"])", R"(["c","d"])", R"(["c","d"])"},
                {R"({"a":"b"})", R"(["c"])", R"(["c"])"},
                {R"({"a":"foo"})", R"(null)", R"(null)"},
                {R"({"a":"foo"})", R"("bar")", R"("bar")"},
                {R"({"e":null})", R"({"a":1})", R"({"e":null,"a":1})"},
                {R"([1,2])", R"({"a":"b","c":null})", R"({"a":"b"})"},
                {R"({})", R"({"a":{"bb":{"ccc":null}}})", R"({"a":{"bb":{}}})"}};
    for (const auto& row : rows) {
        Json value = Json::parse(row.original, "original");
        value.merge(Json::parse(row.patch, "patch"));
        EXPECT_EQ(value.plain().dump(), row.result) << row.original << " patched with " << row.patch;
    }
}

// If this fails, a mistake in a variant is reported at the place of the graph it patches, or nowhere.
TEST(Json, MergedValuesKeepTheirPlaces) {
    Json graph = Json::parse("{\"passes\": {\"a\": {\"set\": {\"x\": 1}}}}", "graph");
    graph.merge(Json::parse("{\"passes\": {\"a\": {\"set\": {\"x\": 2}},\n \"b\": {\"type\": \"t\"}}}", "patch"));
    const Json& a = *graph.find("passes")->find("a");
    EXPECT_EQ(a.where().file, "graph");
    EXPECT_EQ(a.find("set")->find("x")->where().file, "patch");
    EXPECT_EQ(place(a.find("set")->find("x")->where()), "1:32");
    const Json& b = *graph.find("passes")->find("b");
    EXPECT_EQ(b.where().file, "patch");
    EXPECT_EQ(place(b.keyWhere()), "2:2");
    EXPECT_EQ(place(b.where()), "2:7");
}

TEST(Json, ExpectOnlyReportsEveryUnknownKey) {
    Problems problems;
    const std::vector<std::string> known{"type", "in", "set"};
    Json::parse("{\"type\": 1, \"sets\": 2,\n \"zzz\": 3}", "f").expectOnly(known, "pass \"a\"", problems);
    ASSERT_EQ(problems.list().size(), 2u);
    EXPECT_EQ(problems.list()[0].text(), "f:1:13: unknown key \"sets\" in pass \"a\"; did you mean \"set\"?");
    EXPECT_EQ(problems.list()[1].text(), "f:2:2: unknown key \"zzz\" in pass \"a\"; known: type, in, set");
}

TEST(Json, LoadNamesTheFile) {
    const Path path = Path(testing::TempDir()) / "lodestir_json_test.json";
    writeFile(path, std::string_view("{\n  \"a\": tru\n}"));
    try {
        Json::load(path);
        FAIL() << "load() must throw";
    } catch (const Error& error) {
        EXPECT_EQ(error.what(), path.string() + ":2:8: expected a value after ':', found 'tru'");
    }
    std::filesystem::remove(path);
    EXPECT_THROW(Json::load(path), Error);
}

}  // namespace
}  // namespace lodestir
