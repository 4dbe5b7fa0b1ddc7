// SPDX-License-Identifier: MIT
// GLSL -> SPIR-V in process (glslang), with the closure of includes known and the result kept on disk by content.
#include <framework/gpu/shader.h>

#include <framework/core/error.h>
#include <framework/core/log.h>
#include <framework/gpu/include_closure.h>
#include <framework/gpu/texel_reads.h>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/build_info.h>

#include <charconv>
#include <cstring>
#include <optional>
#include <set>

namespace lodestir::gpu {

namespace {

// Every shader may use these without saying so; an extension that isn't used leaves no trace in the SPIR-V's capabilities.
constexpr const char* extensions[] = {
    "GL_GOOGLE_include_directive",
    "GL_EXT_scalar_block_layout",
    "GL_EXT_buffer_reference",
    "GL_EXT_buffer_reference2",
    "GL_EXT_buffer_reference_uvec2",
    "GL_EXT_shader_explicit_arithmetic_types_int64",
    "GL_EXT_shader_explicit_arithmetic_types_int16",
    "GL_EXT_shader_explicit_arithmetic_types_int8",
    "GL_EXT_shader_16bit_storage",
    "GL_EXT_shader_8bit_storage",
    "GL_EXT_shader_atomic_int64",
    "GL_EXT_shader_atomic_float",
    "GL_EXT_ray_query",
    "GL_EXT_nonuniform_qualifier",
    "GL_KHR_shader_subgroup_basic",
    "GL_KHR_shader_subgroup_vote",
    "GL_KHR_shader_subgroup_ballot",
    "GL_KHR_shader_subgroup_shuffle",
    "GL_KHR_shader_subgroup_shuffle_relative",
    "GL_KHR_shader_subgroup_arithmetic",
    "GL_EXT_shader_subgroup_extended_types_int64",
    "GL_EXT_control_flow_attributes",
};

// Bump when this file compiles the same input to other words.
constexpr std::uint32_t cacheFormat = 2;

std::string preamble(const ShaderSource& source) {
    std::string text;
    for (const char* extension : extensions) text += fmt::format("#extension {} : enable\n", extension);
    for (const auto& [name, value] : source.defines) text += fmt::format("#define {} {}\n", name, value);
    return text;
}

// A text as glslang gets it. The name in each #include line becomes the number of its target, and #line directives number the
// texts, so that messages and __FILE__ tell the text by its index in the closure.
std::string numberedText(const IncludeClosure& closure, std::size_t index) {
    const ShaderText& source = closure.texts()[index];
    std::string text = index == 0 ? std::string() : fmt::format("#line 1 {}\n", index);  // nothing may precede the entry's #version
    std::size_t done = 0;
    for (const Include& include : source.includes) {
        text.append(source.text, done, include.begin - done);
        const std::string target = include.target < 0 ? include.name : fmt::format(":{}", include.target);
        text += fmt::format("#include \"{}\"\n#line {} {}", target, include.line + 1, index);
        done = include.end;
    }
    text.append(source.text, done);
    return text;
}

// Hands out the texts of a closure by number, each one once.
class ClosureIncluder final : public glslang::TShader::Includer {
public:
    explicit ClosureIncluder(const IncludeClosure& closure) : closure_(closure), given_(closure.texts().size(), false) { given_[0] = true; }

    IncludeResult* includeSystem(const char* name, const char*, std::size_t) override {
        std::size_t index = 0;
        const char* end = name + std::strlen(name);
        if (name[0] != ':' || std::from_chars(name + 1, end, index).ptr != end || index >= given_.size()) {
            static constexpr std::string_view missing = "no such file beside this one or in the include folders,";
            return results_.emplace_back(std::make_unique<IncludeResult>("", missing.data(), missing.size(), nullptr)).get();
        }
        std::string& text =
            texts_.emplace_back(std::make_unique<std::string>())->append(given_[index] ? "" : numberedText(closure_, index));
        given_[index] = true;
        return results_.emplace_back(std::make_unique<IncludeResult>(closure_.texts()[index].name, text.data(), text.size(), nullptr))
            .get();
    }
    void releaseInclude(IncludeResult*) override {}  // all live as long as this object

private:
    const IncludeClosure& closure_;
    std::vector<bool> given_;
    std::vector<std::unique_ptr<std::string>> texts_;
    std::vector<std::unique_ptr<IncludeResult>> results_;
};

// Line `number` of a text, without blanks at its ends.
std::string lineOf(const std::string& text, int number) {
    std::size_t begin = 0;
    for (int i = 1; i < number && begin != std::string::npos; ++i) {
        begin = text.find('\n', begin);
        if (begin != std::string::npos) ++begin;
    }
    if (begin == std::string::npos || begin >= text.size()) return {};
    std::string line = text.substr(begin, text.find('\n', begin) - begin);
    line.erase(0, line.find_first_not_of(" \t"));
    line.erase(line.find_last_not_of(" \t\r") + 1);
    return line;
}

// One line of glslang's log: "ERROR: 2:31: 'x' : undeclared identifier" with 2 the number of the text.
std::optional<Problem> parseMessage(std::string_view line, const IncludeClosure& closure) {
    std::size_t index = 0;
    int number = 0;
    const char* end = line.data() + line.size();
    const auto afterIndex = std::from_chars(line.data(), end, index);
    if (afterIndex.ec != std::errc{} || afterIndex.ptr == end || *afterIndex.ptr != ':' || index >= closure.texts().size()) return {};
    const auto afterNumber = std::from_chars(afterIndex.ptr + 1, end, number);
    if (afterNumber.ec != std::errc{} || afterNumber.ptr == end || *afterNumber.ptr != ':') return {};
    std::string_view what(afterNumber.ptr + 1, static_cast<std::size_t>(end - afterNumber.ptr - 1));
    what.remove_prefix(std::min(what.find_first_not_of(' '), what.size()));
    what = what.substr(0, what.find_last_not_of(' ') + 1);
    if (what.starts_with("'' : ")) what.remove_prefix(5);
    const std::string shown = lineOf(closure.texts()[index].text, number);
    return Problem{{closure.texts()[index].name, number, 0}, std::string(what), shown.empty() ? "" : "in: " + shown};
}

// Throws the errors of glslang's log, if there are any, and logs its warnings.
void report(const char* infoLog, bool failed, const IncludeClosure& closure) {
    Problems problems;
    std::set<std::string> seen;
    std::string_view log(infoLog);
    while (!log.empty()) {
        const std::size_t end = std::min(log.find('\n'), log.size());
        std::string_view line = log.substr(0, end);
        log.remove_prefix(std::min(end + 1, log.size()));
        const bool isError = line.starts_with("ERROR: "), isWarning = line.starts_with("WARNING: ");
        if (!isError && !isWarning) continue;
        line.remove_prefix(isError ? 7 : 9);
        if (line.find("compilation errors.") != std::string_view::npos ||
            line.find("'' : compilation terminated") != std::string_view::npos)
            continue;
        const std::optional<Problem> located = parseMessage(line, closure);
        const Problem problem = located.value_or(Problem{{closure.texts()[0].name, 0, 0}, std::string(line), {}});
        if (isWarning) {
            if (seen.insert(problem.text()).second) log::warn("{}", problem.text());
            continue;
        }
        problems.add(problem.where, problem.what, problem.hint);
        // glslang ends the current text at its first error and goes on in the including one, confused; only after a
        // missing include is there more to learn.
        if (located && !problem.what.starts_with("'#include'")) break;
    }
    problems.raise();
    if (failed) throw Error({closure.texts()[0].name, 0, 0}, "the shader does not compile", infoLog);
}

std::vector<std::uint32_t> translate(const ShaderSource& source, const IncludeClosure& closure) {
    static const bool ready = glslang::InitializeProcess();  // the compiler's own tables; once a process
    if (!ready) throw Error("glslang can't be initialised");

    const std::string entry = numberedText(closure, 0), before = preamble(source);
    const char* text = entry.c_str();
    const int length = static_cast<int>(entry.size());
    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengths(&text, &length, 1);
    shader.setPreamble(before.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    ClosureIncluder includer(closure);
    constexpr auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    const bool parsed = shader.parse(GetDefaultResources(), 460, ENoProfile, false, false, messages, includer);
    report(shader.getInfoLog(), !parsed, closure);

    glslang::TProgram program;
    program.addShader(&shader);
    const bool linked = program.link(messages);
    report(program.getInfoLog(), !linked, closure);

    std::vector<std::uint32_t> words;
    spv::SpvBuildLogger logger;
    glslang::SpvOptions options;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words, &logger, &options);
    const std::string said = logger.getAllMessages();
    if (words.empty()) throw Error({closure.texts()[0].name, 0, 0}, "no SPIR-V could be made", said);
    if (!said.empty()) log::warn("{}: {}", closure.texts()[0].name, said);
    return words;
}

Hash hashWords(std::span<const std::byte> bytes) { return Hash().add(bytes); }

// A cached file is the words followed by their hash; anything else is as good as no file.
std::vector<std::uint32_t> readCached(const Path& path) {
    std::error_code missing;
    if (!std::filesystem::is_regular_file(path, missing)) return {};
    try {
        const std::vector<std::byte> bytes = readBytes(path);
        constexpr std::size_t trailer = 2 * sizeof(std::uint64_t);
        if (bytes.size() <= trailer || bytes.size() % sizeof(std::uint32_t) != 0) return {};
        const std::span<const std::byte> words(bytes.data(), bytes.size() - trailer);
        Hash stored;
        std::memcpy(&stored.a, bytes.data() + words.size(), sizeof stored.a);
        std::memcpy(&stored.b, bytes.data() + words.size() + sizeof stored.a, sizeof stored.b);
        if (!(stored == hashWords(words))) return {};
        std::vector<std::uint32_t> result(words.size() / sizeof(std::uint32_t));
        std::memcpy(result.data(), words.data(), words.size());
        return result;
    } catch (const Error&) {
        return {};  // unreadable: compile again
    }
}

void writeCached(const Path& path, const std::vector<std::uint32_t>& words) {
    const auto content = std::as_bytes(std::span(words));
    const Hash hash = hashWords(content);
    std::vector<std::byte> bytes(content.begin(), content.end());
    for (const std::uint64_t half : {hash.a, hash.b}) {
        const auto tail = std::as_bytes(std::span(&half, 1));
        bytes.insert(bytes.end(), tail.begin(), tail.end());
    }
    try {
        writeFile(path, bytes);
    } catch (const Error& error) {
        log::note("shader cache: {}", error.what());  // slower next time, no worse
    }
}

}  // namespace

Spirv compileShader(const ShaderSource& source) {
    const IncludeClosure closure(source.file, source.folders, source.generated);
    const std::string before = preamble(source);
    Hash hash;
    hash.addValue(cacheFormat).addValue(GLSLANG_VERSION_MAJOR).addValue(GLSLANG_VERSION_MINOR).addValue(GLSLANG_VERSION_PATCH);
    hash.addValue(before.size()).add(before).addValue(source.texelReads);
    closure.addTo(hash);

    Spirv spirv;
    spirv.hash = hash;
    spirv.files = closure.files();
    const Path path = cacheFolder("spirv") / (hash.hex() + ".spv");
    spirv.words = readCached(path);
    spirv.cached = !spirv.words.empty();
    if (!spirv.cached) {
        spirv.words = translate(source, closure);
        if (source.texelReads) spirv.words = readByTexels(spirv.words);
        writeCached(path, spirv.words);
    }
    return spirv;
}

Hash includeClosure(const Path& file, const std::vector<Path>& folders) {
    Hash hash;
    IncludeClosure(file, folders, {}).addTo(hash);
    return hash;
}

}  // namespace lodestir::gpu
