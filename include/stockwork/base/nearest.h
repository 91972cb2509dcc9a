#pragma once

#include <string>
#include <vector>

namespace stockwork
{
/// The number of insertions, deletions, replacements and swaps of neighbours that turn one text
/// into the other; upper and lower case are the same letter at no cost.
unsigned int edit_distance(const std::string &a, const std::string &b);

/// Those candidates that a mistyped @p name may have meant, the nearest first, at most
/// @p max_results.
std::vector<std::string> nearest_names(const std::string &name,
                                       const std::vector<std::string> &candidates,
                                       unsigned int max_results = 3);

/// "did you mean 'a' or 'b'?"; empty if nothing is near.
std::string did_you_mean(const std::string &name, const std::vector<std::string> &candidates);

/// "'a', 'b' and 'c'" with @p conjunction before the last.
std::string quoted_list(const std::vector<std::string> &names,
                        const std::string &conjunction = "and");
} // namespace stockwork
