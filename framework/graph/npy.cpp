// SPDX-License-Identifier: MIT
// Writes .npy files as NumPy's documentation describes them (numpy.lib.format, versions 1.0 and 2.0).
#include <framework/graph/npy.h>

#include <framework/core/error.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {
namespace {

std::string tupleText(std::span<const std::size_t> numbers) {
    std::string text = "(";
    for (std::size_t i = 0; i < numbers.size(); ++i) text += (i ? ", " : "") + std::to_string(numbers[i]);
    return text + (numbers.size() == 1 ? ",)" : ")");
}

std::string scalarText(const NumberType& number) {
    return std::string("'") + (number.bytes == 1 ? '|' : '<') + number.kind + std::to_string(number.bytes) + "'";
}

/// The axes that a member adds: its array, then rows and columns of its type.
std::vector<std::size_t> axesOf(const StructField& field) {
    std::vector<std::size_t> axes;
    if (field.count) axes.push_back(field.count);
    const NumberType number = numberType(field.type);
    if (number.kind && number.rows > 1) axes.push_back(number.rows);
    if (number.kind && number.columns > 1) axes.push_back(number.columns);
    return axes;
}

/// A structured dtype of `size` bytes as the list that NumPy writes; unnamed voids fill the gaps.
std::string structText(std::span<const StructField> fields, std::size_t size) {
    std::string text = "[";
    std::size_t end = 0;
    const auto fillTo = [&](std::size_t offset) {
        if (offset > end) text += (text.size() > 1 ? ", " : "") + ("('', '|V" + std::to_string(offset - end) + "')");
    };
    for (const StructField& field : fields) {
        fillTo(field.offset);
        const NumberType number = numberType(field.type);
        const std::vector<std::size_t> axes = axesOf(field);
        text += (text.size() > 1 ? ", ('" : "('") + field.name + "', " +
                (number.kind ? scalarText(number) : structText(field.members, field.size));
        if (!axes.empty()) text += ", " + tupleText(axes);
        text += ")";
        end = field.offset + field.size * std::max<std::size_t>(field.count, 1);
    }
    fillTo(size);
    return text + "]";
}

}  // namespace

void writeNpy(const Path& path, std::span<const std::byte> bytes, std::span<const StructField> fields, std::span<const std::size_t> shape) {
    const std::size_t count = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
    const std::size_t end = fields.empty() ? 0 : fields.back().offset + fields.back().size * std::max<std::size_t>(fields.back().count, 1);
    const std::size_t element = count ? bytes.size() / count : end;
    if (fields.empty() || element < end || bytes.size() != element * count)
        throw Error(Where{path.string()}, std::to_string(bytes.size()) + " bytes are no array of shape " + tupleText(shape) +
                                              " of elements of " + std::to_string(end) + " bytes");

    const bool plain = fields.size() == 1 && fields[0].name.empty();
    if (plain && element != end)
        throw Error(Where{path.string()}, "elements of " + std::to_string(element) + " bytes are no " + fields[0].type);
    std::vector<std::size_t> axes(shape.begin(), shape.end());
    if (plain)
        for (const std::size_t axis : axesOf(fields[0])) axes.push_back(axis);
    const std::string dtype = plain ? scalarText(numberType(fields[0].type)) : structText(fields, element);
    std::string header = "{'descr': " + dtype + ", 'fortran_order': False, 'shape': " + tupleText(axes) + ", }";

    // Magic, version and length take 10 bytes (12 in version 2.0); blanks make the data start at a multiple of 64.
    const std::size_t lengthBytes = header.size() + 64 + 10 > 0xffff ? 4 : 2;
    const std::size_t before = 8 + lengthBytes;
    header.append(63 - (before + header.size()) % 64, ' ');
    header += '\n';
    std::string file = "\x93NUMPY";
    file += lengthBytes == 2 ? '\x01' : '\x02';
    file += '\0';
    for (std::size_t i = 0; i < lengthBytes; ++i) file += static_cast<char>(header.size() >> (8 * i) & 0xff);
    file += header;
    file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    writeFile(path, file);
}

}  // namespace lodestir
