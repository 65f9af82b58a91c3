// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/meant_name.h>

#include <cctype>

#include <tetralight/base/suggest.h>

namespace tetralight::detail {
namespace {

/// "contributeGI", "contribute-gi" and "Contribute GI" as "contributegi".
std::string plain_letters(std::string_view word) {
    std::string letters;
    for (const char c : word) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) continue;
        letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return letters;
}

}  // namespace

std::string meant_name(std::string_view word, std::span<const std::string> names) {
    constexpr size_t kShortest = 5;  // shorter words are near to too many others
    const std::string letters = plain_letters(word);
    for (const std::string& name : names) {
        if (plain_letters(name) == letters) return name;
    }
    return letters.size() < kShortest ? "" : closest(word, names);
}

}  // namespace tetralight::detail
