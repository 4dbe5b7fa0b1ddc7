// SPDX-License-Identifier: MIT
// What names the results of a study: a scene that differs in anything that an image could show has to have another name.
#include <framework/scene/visit.h>
#include <framework/study/content.h>

#include <gtest/gtest.h>

namespace lodestir {
namespace {

template <class T> concept Text = std::same_as<T, std::string> || std::same_as<T, Path>;
template <class T> concept Number = std::is_arithmetic_v<T>;
template <class T> concept Choice = std::is_enum_v<T>;
template <class T> concept Tuple = requires(T t) { typename T::value_type; t[0]; } && !Text<T>;  // an array, or a vector or matrix of glm's
template <class T> concept List = Tuple<T> && requires(T t) { t.emplace_back(); };
template <class T> concept Maybe = requires(T t) { t.emplace(); } && !Tuple<T>;

/// Makes something of everything that a scene may hold.
struct Grower {
    template <class T> void operator()(T& value) {
        if constexpr (Text<T> || Number<T> || Choice<T>) {
        } else if constexpr (Maybe<T>) {
            (*this)(value.emplace());
        } else if constexpr (List<T>) {
            if (value.empty()) value.emplace_back();
            for (auto& item : value) (*this)(item);
        } else if constexpr (!Tuple<T>) {
            visit(*this, value);
        }
    }
};

/// Changes one thing of a scene, the one with the number `left`: a number, a text, the length of a list, whether there is something.
struct Changer {
    int left;
    bool done = false, text = false;

    bool isTurn() { return !done && left-- == 0 && (done = true); }

    template <class T> void operator()(T& value) {
        if constexpr (Text<T>) {
            if (isTurn()) text = true, value += "x";
        } else if constexpr (std::same_as<T, bool>) {
            if (isTurn()) value = !value;
        } else if constexpr (Number<T>) {
            if (isTurn()) value += T(1);
        } else if constexpr (Choice<T>) {
            if (isTurn()) value = T(int(value) + 1);
        } else if constexpr (Maybe<T>) {
            if (isTurn()) return value.reset();
            (*this)(*value);
        } else if constexpr (Tuple<T>) {
            if constexpr (List<T>)
                if (isTurn()) return text = Text<typename T::value_type>, void(value.emplace_back());
            for (int i = 0; i < int(sizeOf(value)); ++i) (*this)(value[i]);
        } else {
            visit(*this, value);
        }
    }

    static auto sizeOf(const auto& tuple) {
        if constexpr (requires { tuple.size(); }) return tuple.size();
        else return tuple.length();
    }
};

Scene someScene() {
    Scene scene;
    Grower{}(scene);
    return scene;
}

TEST(Content, EveryFieldOfASceneCounts) {
    const Hash before = contentOf(someScene());
    EXPECT_EQ(contentOf(someScene()), before);
    int changes = 0, texts = 0;
    while (true) {
        Scene scene = someScene();
        Changer changer{changes};
        changer(scene);
        if (!changer.done) break;
        EXPECT_EQ(contentOf(scene) == before, changer.text) << "change " << changes << " of the order in scene/visit.h";
        ++changes;
        texts += changer.text;
    }
    EXPECT_GT(changes, 300);
    EXPECT_GT(texts, 5);
}

// What was forgotten when fields were listed by hand.
TEST(Content, LayersOfAMaterialCount) {
    Scene plain = someScene(), coated = someScene();
    coated.materials[0].layers->coat = 0.5f;
    EXPECT_NE(contentOf(plain), contentOf(coated));
}

}  // namespace
}  // namespace lodestir
