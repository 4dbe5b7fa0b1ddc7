// SPDX-License-Identifier: MIT
// Mutates JSON text as a tree: what a parser would refuse tells nothing of the code behind it.
#pragma once
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace lodestir::fuzz {

class JsonMutator {
public:
    using Tree = nlohmann::ordered_json;

    explicit JsonMutator(unsigned seed) : random_(seed) {}

    /// One to four changes of the tree; of the bytes now and then, and where they are no JSON. Never longer than maxSize.
    std::string mutated(const std::string& text, std::size_t maxSize) {
        Tree tree = Tree::parse(text, nullptr, false, /* ignore_comments = */ false);
        if (tree.is_discarded() || below(16) == 0) return mutatedBytes(text, maxSize);
        for (unsigned changes = 1 + below(4); changes > 0; --changes) change(tree);
        const std::string result = tree.dump(-1, ' ', false, Tree::error_handler_t::replace);
        return result.size() <= maxSize ? result : mutatedBytes(text, maxSize);
    }

private:
    unsigned below(std::size_t count) { return static_cast<unsigned>(random_() % count); }

    static std::string mutatedBytes(std::string text, std::size_t maxSize) {
        text.resize(std::min(text.size(), maxSize));
        const std::size_t before = text.size();
        text.resize(maxSize);
        text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), before, maxSize));
        return text;
    }

    static void gather(Tree& value, std::vector<Tree*>& all) {
        all.push_back(&value);
        if (value.is_structured()) {
            for (Tree& child : value) gather(child, all);
        }
    }

    Tree number() {
        static const std::vector<Tree> known{0, 1, -1, 2, 3, 4, 16, 127, 128, 255, 256, 65535, 65536, 2147483647, 2147483648u, 4294967295u,
                                             4294967296, -2147483648ll, 9007199254740993, 9223372036854775807, 18446744073709551615u, 0.5,
                                             -0.0, 1e-30, 1e30, -1e30, 1e38, 3.5e38, 1e300, -1e300, 1e-320, 5120, 5121, 5123, 5125, 5126};
        return below(4) == 0 ? Tree(static_cast<int>(below(12))) : known[below(known.size())];
    }

    void change(Tree& tree) {
        std::vector<Tree*> all;
        gather(tree, all);
        Tree& value = *all[below(all.size())];
        const Tree other = *all[below(all.size())];
        switch (below(8)) {
        case 0: value = other; break;
        case 1: changeChildren(value, other); break;
        case 2: changeChildren(*all[below(all.size())], other); break;
        case 3: changeText(value); break;
        case 4: value = std::vector<Tree>{nullptr, Tree::array(), Tree::object(), "", true, 0}[below(6)]; break;
        default: changeNumber(all); break;  // the likeliest thing to be trusted too much
        }
    }

    void changeNumber(const std::vector<Tree*>& all) {
        std::vector<Tree*> numbers;
        std::copy_if(all.begin(), all.end(), std::back_inserter(numbers), [](const Tree* value) { return value->is_number(); });
        if (!numbers.empty()) *numbers[below(numbers.size())] = number();
    }

    void changeText(Tree& value) {
        if (value.is_string()) value = mutatedBytes(value.get<std::string>(), value.get_ref<const std::string&>().size() + 16);
    }

    void changeChildren(Tree& value, const Tree& other) {
        if (value.is_array() && !value.empty()) {
            const auto place = std::next(value.begin(), below(value.size()));
            if (below(3) == 0) {
                value.erase(place);
            } else {
                const Tree copy = below(2) == 0 ? other : *place;
                for (unsigned copies = below(8) == 0 ? 100 : 1; copies > 0; --copies) value.push_back(copy);
            }
        } else if (value.is_object() && !value.empty()) {
            const std::string key = std::next(value.begin(), below(value.size())).key();
            if (below(2) == 0)
                value.erase(key);
            else
                value[below(2) == 0 ? key + "2" : key] = other;
        }
    }

    std::minstd_rand random_;
};

}  // namespace lodestir::fuzz

/// For targets whose input is JSON text: defines libFuzzer's mutator.
#define LODESTIR_MUTATE_JSON                                                                                                            \
    extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize, unsigned seed) {         \
        const std::string text(reinterpret_cast<const char*>(data), size);                                                              \
        const std::string mutated = lodestir::fuzz::JsonMutator(seed).mutated(text, maxSize);                                           \
        std::memcpy(data, mutated.data(), mutated.size());                                                                              \
        return mutated.size();                                                                                                          \
    }
