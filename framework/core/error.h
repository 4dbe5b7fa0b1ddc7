// SPDX-License-Identifier: MIT
// What is told to people when their input is wrong: where it is, what is wrong, what would help.
#pragma once
#include <framework/core/api.h>

#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

/// A place in a file. Lines and columns count from 1; 0 means "the whole file" or "the whole line".
struct Where {
    std::string file;
    int line = 0;
    int column = 0;
};

/// One thing that is wrong. Its text is "file:line:column: what; hint", leaving out the parts that are empty.
struct Problem {
    Where where;
    std::string what;
    std::string hint;

    LODESTIR_API std::string text() const;
};

/// Thrown for wrong input; carries all the problems that were found, in the order of their places.
class LODESTIR_API Error : public std::exception {
public:
    explicit Error(std::vector<Problem> problems);
    Error(Where where, std::string what, std::string hint = {});
    explicit Error(std::string what, std::string hint = {});
    ~Error() override;

    const char* what() const noexcept override { return text_.c_str(); }
    const std::vector<Problem>& problems() const { return problems_; }

private:
    std::vector<Problem> problems_;
    std::string text_;  ///< one line a problem
};

/// Gathers problems so that a file's mistakes are reported all at once.
class LODESTIR_API Problems {
public:
    void add(Where where, std::string what, std::string hint = {});
    void add(const Error& error);
    /// Does a part and gathers the Error that it throws, so that the parts after it are tried as well.
    template <class F> void attempt(const F& part) {
        try {
            part();
        } catch (const Error& error) {
            add(error);
        }
    }
    bool empty() const { return problems_.empty(); }
    const std::vector<Problem>& list() const { return problems_; }
    /// Throws Error with everything gathered, sorted by place; does nothing when there is nothing.
    void raise() const;

private:
    std::vector<Problem> problems_;
};

/// A hint such as `did you mean "rounds"?` when a candidate is close to `name` (edit distance), else
/// `known: a, b, c` (at most eight names), else empty.
LODESTIR_API std::string didYouMean(std::string_view name, std::span<const std::string> candidates);

}  // namespace lodestir
