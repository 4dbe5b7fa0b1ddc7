// SPDX-License-Identifier: MIT
// Turns reads of arrays through device addresses into fetches from one texel buffer over the same memory.
#include <framework/gpu/texel_reads.h>

#include <framework/gpu/spirv_module.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>

namespace lodestir::gpu {

namespace {

using Id = std::uint32_t;
using Words = std::vector<std::uint32_t>;

void append(Words& to, spv::Op op, std::initializer_list<std::uint32_t> operands, std::span<const std::uint32_t> more = {}) {
    to.push_back(std::uint32_t(operands.size() + more.size() + 1) << 16 | op);
    to.insert(to.end(), operands);
    to.insert(to.end(), more.begin(), more.end());
}

/// The largest power of two that divides n, 16 at most.
std::uint32_t alignmentOf(std::uint32_t n) { return n == 0 ? 16 : std::min(n & (~n + 1), 16u); }

/// Where a read begins: at an address, plus indices times strides, plus bytes that are known.
struct Place {
    struct Term {
        Id index;
        std::uint32_t stride;
    };
    Id base;                  ///< pointer to the block
    std::vector<Term> terms;
    std::uint32_t bytes = 0;
    std::uint32_t alignment = 16;  ///< of all but `bytes`: 4, 8 or 16
    std::uint32_t matrixStride = 0;  ///< where the read is of a matrix
};

/// What is fetched for one read: texels from a first one on, or pairs of words, or words, as the alignment has it.
struct Fetch {
    Id start;  ///< index of the first texel, pair or word
    std::uint32_t alignment;
    std::map<std::uint32_t, Id> texels;  ///< by their distance from the first, or by that of their pairs or words
    std::map<std::uint32_t, Id> numbers;  ///< constants are added once
};

class Rewriter {
public:
    explicit Rewriter(const SpirvModule& module) : m_(module), next_(module.bound) {}

    Words run();

private:
    std::optional<Place> placeOf(const Instruction& load) const;
    bool canRead(Id type) const;
    bool isReadOnlyArray(Id block, std::uint32_t member) const;
    Id blockOf(Id pointer) const;
    void findWritten();

    void rewrite(const Instruction& load, const Place& place);
    Id startOf(const Place& place);
    Id read(Id type, Fetch& fetch, std::uint32_t byte, std::uint32_t matrixStride, Id result);
    Id word(Fetch& fetch, std::uint32_t byte);
    Id texel(Fetch& fetch, std::uint32_t distance);
    Id asUint(Id value);

    Id declared(spv::Op op, std::initializer_list<std::uint32_t> operands);
    Id number(std::uint32_t value) { return declared(spv::OpConstant, {uint_, value}); }
    Id emit(spv::Op op, Id type, std::initializer_list<std::uint32_t> operands, Id result = 0);
    Id binary(spv::Op op, Id a, Id b) { return emit(op, uint_, {a, b}); }
    std::uint32_t operand(Id type, std::size_t i) const { return m_.definition(type)[i]; }

    const SpirvModule& m_;
    Id next_;
    Words declarations_, body_;
    std::map<Words, Id> declared_;
    std::set<Id> written_;  ///< blocks
    Id uint_ = 0, image_ = 0, variable_ = 0;
};

/// The block that a pointer made by an access chain leads into; 0 for other pointers.
Id Rewriter::blockOf(Id pointer) const {
    const Instruction& chain = m_.definition(pointer);
    if (chain.op() != spv::OpAccessChain && chain.op() != spv::OpInBoundsAccessChain) return 0;
    if (operand(chain[1], 2) != spv::StorageClassPhysicalStorageBuffer) return 0;
    return operand(m_.typeOf(chain[3]), 3);
}

/// Whoever takes a pointer, but for loads and further steps, may write there.
void Rewriter::findWritten() {
    for (const Instruction& i : m_.instructions) {
        switch (i.op()) {
        case spv::OpLoad:
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain: continue;
        case spv::OpStore: written_.insert(blockOf(i[1])); continue;
        default: break;
        }
        if (i.op() < spv::OpFunction) continue;  // names, types and constants hold no pointers
        for (const std::uint32_t word : i.words.subspan(1))
            if (word < m_.bound && m_.typeOf(word)) written_.insert(blockOf(word));
    }
}

/// Whether reads of a block's member are fetched: a runtime array that nobody changes meanwhile.
bool Rewriter::isReadOnlyArray(Id block, std::uint32_t member) const {
    const bool shared = m_.memberDecoration(block, member, spv::DecorationVolatile) || m_.memberDecoration(block, member, spv::DecorationCoherent);
    return m_.definition(m_.definition(block)[2 + member]).op() == spv::OpTypeRuntimeArray && !written_.contains(block) && !shared;
}

/// Whether all numbers in a type have 32 or 64 bits.
bool Rewriter::canRead(Id type) const {
    const Instruction& t = m_.definition(type);
    switch (t.op()) {
    case spv::OpTypeInt:
    case spv::OpTypeFloat: return t[2] >= 32;
    case spv::OpTypeVector:
    case spv::OpTypeMatrix: return canRead(t[2]);
    case spv::OpTypeArray: return canRead(t[2]) && m_.constant(t[3]).has_value();
    case spv::OpTypeStruct: return std::ranges::all_of(t.words.subspan(2), [&](Id member) { return canRead(member); });
    case spv::OpTypePointer: return t[2] == spv::StorageClassPhysicalStorageBuffer;
    default: return false;
    }
}

std::optional<Place> Rewriter::placeOf(const Instruction& load) const {
    if (load.op() != spv::OpLoad) return std::nullopt;
    const Id block = blockOf(load[3]);
    if (!block || m_.definition(block).op() != spv::OpTypeStruct) return std::nullopt;
    const Instruction& chain = m_.definition(load[3]);
    const std::optional<std::uint32_t> first = m_.constant(chain[4]);
    if (!first || !isReadOnlyArray(block, *first) || !canRead(load[1])) return std::nullopt;

    Place place{.base = chain[3]};
    Id type = block;
    for (std::size_t i = 4; i < chain.size(); ++i) {
        const Instruction& t = m_.definition(type);
        const std::optional<std::uint32_t> index = m_.constant(chain[i]);
        std::uint32_t stride = 4;  // of a vector's components
        if (t.op() == spv::OpTypeStruct) {
            place.bytes += m_.memberDecoration(type, *index, spv::DecorationOffset).value_or(0);
            place.matrixStride = m_.memberDecoration(type, *index, spv::DecorationMatrixStride).value_or(0);
            if (m_.memberDecoration(type, *index, spv::DecorationRowMajor)) return std::nullopt;
            type = t[2 + *index];
            continue;
        }
        if (t.op() == spv::OpTypeMatrix) stride = place.matrixStride;
        else if (t.op() == spv::OpTypeVector) stride = operand(t[2], 2) / 8;
        else stride = m_.decoration(type, spv::DecorationArrayStride).value_or(0);
        if (t.op() == spv::OpTypeRuntimeArray) place.alignment = alignmentOf(stride);
        if (index) {
            place.bytes += *index * stride;
        } else {
            place.terms.push_back({chain[i], stride});
            place.alignment = std::min(place.alignment, alignmentOf(stride));
        }
        type = t[2];
    }
    return place.alignment >= 4 && place.bytes % 4 == 0 ? std::optional(std::move(place)) : std::nullopt;
}

/// The id of a type, constant or variable: the module's own where it has one.
Id Rewriter::declared(spv::Op op, std::initializer_list<std::uint32_t> operands) {
    Words key{std::uint32_t(op)};
    key.insert(key.end(), operands);
    Id& id = declared_[key];
    if (id) return id;
    id = next_++;
    const bool typed = op == spv::OpConstant || op == spv::OpVariable;
    if (typed) append(declarations_, op, {*operands.begin(), id}, std::span(operands.begin() + 1, operands.end()));
    else append(declarations_, op, {id}, operands);
    return id;
}

Id Rewriter::emit(spv::Op op, Id type, std::initializer_list<std::uint32_t> operands, Id result) {
    if (!result) result = next_++;
    append(body_, op, {type, result}, operands);
    return result;
}

Id Rewriter::asUint(Id value) {
    const Instruction& type = m_.definition(m_.typeOf(value));
    if (type[2] == 64) return emit(spv::OpUConvert, uint_, {value});
    return m_.typeOf(value) == uint_ ? value : emit(spv::OpBitcast, uint_, {value});
}

/// Index of the texel, pair of words or word that the place lies in, but for the bytes that are known.
Id Rewriter::startOf(const Place& place) {
    const Id address = emit(spv::OpConvertPtrToU, declared(spv::OpTypeInt, {64, 0}), {place.base});
    const std::uint32_t shift = place.alignment == 16 ? 4 : place.alignment == 8 ? 3 : 2;
    Id start = binary(spv::OpShiftRightLogical, emit(spv::OpUConvert, uint_, {address}), number(shift));
    for (const Place::Term& term : place.terms) {
        const std::uint32_t steps = term.stride >> shift;
        const Id index = asUint(term.index);
        start = binary(spv::OpIAdd, start, steps == 1 ? index : binary(spv::OpIMul, index, number(steps)));
    }
    return start;
}

/// The texel that holds unit `distance` after the first one.
Id Rewriter::texel(Fetch& fetch, std::uint32_t distance) {
    Id& known = fetch.texels[distance];
    if (known) return known;
    Id at = distance == 0 ? fetch.start : binary(spv::OpIAdd, fetch.start, number(distance));
    fetch.numbers[distance] = at;
    if (fetch.alignment < 16) at = binary(spv::OpShiftRightLogical, at, number(fetch.alignment == 8 ? 1 : 2));
    const Id image = emit(spv::OpLoad, image_, {variable_});
    return known = emit(spv::OpImageRead, declared(spv::OpTypeVector, {uint_, 4}), {image, at});
}

/// 32 bits, `byte` bytes after the start.
Id Rewriter::word(Fetch& fetch, std::uint32_t byte) {
    const std::uint32_t distance = byte / fetch.alignment, place = byte % fetch.alignment / 4;
    const Id all = texel(fetch, distance);
    if (fetch.alignment == 16) return emit(spv::OpCompositeExtract, uint_, {all, place});
    const Id at = fetch.numbers[distance];
    if (fetch.alignment == 4) return emit(spv::OpVectorExtractDynamic, uint_, {all, binary(spv::OpBitwiseAnd, at, number(3))});
    const Id odd = emit(spv::OpINotEqual, declared(spv::OpTypeBool, {}), {binary(spv::OpBitwiseAnd, at, number(1)), number(0)});
    const Id low = emit(spv::OpCompositeExtract, uint_, {all, place}), high = emit(spv::OpCompositeExtract, uint_, {all, place + 2});
    return emit(spv::OpSelect, uint_, {odd, high, low});
}

/// A value of the type, `byte` bytes after the start, put together from words.
Id Rewriter::read(Id type, Fetch& fetch, std::uint32_t byte, std::uint32_t matrixStride, Id result) {
    const Instruction& t = m_.definition(type);
    Words parts;
    switch (t.op()) {
    case spv::OpTypeInt:
    case spv::OpTypeFloat: {
        Id bits = word(fetch, byte);
        if (t[2] == 64) {
            const Id high = word(fetch, byte + 4);
            bits = emit(spv::OpCompositeConstruct, declared(spv::OpTypeVector, {uint_, 2}), {bits, high});
        }
        if (type != uint_) return emit(spv::OpBitcast, type, {bits}, result);
        return result ? emit(spv::OpCopyObject, type, {bits}, result) : bits;
    }
    case spv::OpTypePointer: {
        const Id whole = declared(spv::OpTypeInt, {64, 0});
        const Id low = word(fetch, byte), high = word(fetch, byte + 4);
        const Id bits = emit(spv::OpCompositeConstruct, declared(spv::OpTypeVector, {uint_, 2}), {low, high});
        return emit(spv::OpConvertUToPtr, type, {emit(spv::OpBitcast, whole, {bits})}, result);
    }
    case spv::OpTypeVector:
        for (std::uint32_t i = 0; i < t[3]; ++i) parts.push_back(read(t[2], fetch, byte + i * operand(t[2], 2) / 8, 0, 0));
        break;
    case spv::OpTypeMatrix:
        for (std::uint32_t i = 0; i < t[3]; ++i) parts.push_back(read(t[2], fetch, byte + i * matrixStride, 0, 0));
        break;
    case spv::OpTypeArray: {
        const std::uint32_t stride = m_.decoration(type, spv::DecorationArrayStride).value_or(0);
        for (std::uint32_t i = 0; i < *m_.constant(t[3]); ++i) parts.push_back(read(t[2], fetch, byte + i * stride, matrixStride, 0));
        break;
    }
    default:  // a struct: canRead
        for (std::uint32_t i = 0; i + 2 < t.size(); ++i)
            parts.push_back(read(t[2 + i], fetch, byte + m_.memberDecoration(type, i, spv::DecorationOffset).value_or(0),
                                 m_.memberDecoration(type, i, spv::DecorationMatrixStride).value_or(0), 0));
    }
    if (!result) result = next_++;
    append(body_, spv::OpCompositeConstruct, {type, result}, parts);
    return result;
}

void Rewriter::rewrite(const Instruction& load, const Place& place) {
    Fetch fetch{startOf(place), place.alignment, {}, {}};
    read(load[1], fetch, place.bytes, place.matrixStride, load[2]);
}

Words Rewriter::run() {
    findWritten();
    if (std::ranges::none_of(m_.instructions, [&](const Instruction& i) { return placeOf(i).has_value(); }))
        return {m_.words.begin(), m_.words.end()};
    for (const Instruction& i : m_.instructions) {
        if (i.op() == spv::OpTypeInt || i.op() == spv::OpTypeVector || i.op() == spv::OpTypeBool || i.op() == spv::OpTypeImage) {
            Words key{std::uint32_t(i.op())};
            key.insert(key.end(), i.words.begin() + 2, i.words.end());
            declared_.emplace(std::move(key), i[1]);
        } else if (i.op() == spv::OpConstant && i.size() == 4) {
            declared_.emplace(Words{spv::OpConstant, i[1], i[3]}, i[2]);
        }
    }
    uint_ = declared(spv::OpTypeInt, {32, 0});
    image_ = declared(spv::OpTypeImage, {uint_, spv::DimBuffer, 0, 0, 0, 2, spv::ImageFormatRgba32ui});
    variable_ = declared(spv::OpVariable, {declared(spv::OpTypePointer, {spv::StorageClassUniformConstant, image_}), spv::StorageClassUniformConstant});

    // Capabilities, names and decorations come first, then types and constants, then functions.
    Words head, types;
    bool inTypes = false, inFunctions = false;
    for (const Instruction& i : m_.instructions) {
        inFunctions = inFunctions || i.op() == spv::OpFunction;
        inTypes =
            inTypes || (i.op() >= spv::OpTypeVoid && i.op() <= spv::OpTypeForwardPointer) || (i.op() >= spv::OpConstantTrue && i.op() <= spv::OpSpecConstantOp);
        Words& to = inFunctions ? body_ : inTypes ? types : head;
        if (const std::optional<Place> place = inFunctions ? placeOf(i) : std::nullopt) {
            rewrite(i, *place);
        } else if (i.op() == spv::OpEntryPoint) {
            append(to, i.op(), {}, i.words.subspan(1));
            to[to.size() - i.size()] += 1u << 16;
            to.push_back(variable_);
        } else {
            to.insert(to.end(), i.words.begin(), i.words.end());
        }
    }
    for (const auto& [which, value] : {std::pair(spv::DecorationDescriptorSet, 0u), std::pair(spv::DecorationBinding, 0u)})
        append(head, spv::OpDecorate, {variable_, std::uint32_t(which), value});
    for (const spv::Decoration which : {spv::DecorationNonWritable, spv::DecorationRestrict}) append(head, spv::OpDecorate, {variable_, std::uint32_t(which)});

    Words all(m_.words.begin(), m_.words.begin() + 5);
    all[3] = next_;
    append(all, spv::OpCapability, {spv::CapabilityImageBuffer});
    for (const Words* part : {&head, &types, &declarations_, &body_}) all.insert(all.end(), part->begin(), part->end());
    return all;
}

}  // namespace

std::vector<std::uint32_t> readByTexels(std::span<const std::uint32_t> spirv) { return Rewriter(SpirvModule(spirv)).run(); }

}  // namespace lodestir::gpu
