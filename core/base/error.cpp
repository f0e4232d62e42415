#include "core/base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

#include "core/base/own_name.hpp"

namespace signorini {

void input_error(std::string_view place, std::string_view message) {
  throw Error(Exit::input, fmt::format("{}: {}", place, message));
}

namespace {

// Levenshtein distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// What other programs, textbooks and languages call things, without capitals and underscores.
struct Synonym {
  std::string_view other, own;
};
constexpr Synonym synonyms[] = {
    {"e", "young"},
    {"emodulus", "young"},
    {"elasticmodulus", "young"},
    {"modulus", "young"},
    {"youngmodulus", "young"},
    {"youngsmodulus", "young"},
    {"nu", "poisson"},
    {"poissonratio", "poisson"},
    {"poissonsratio", "poisson"},
    {"conductivity", "diffusion"},
    {"kappa", "diffusion"},
    {"mu", "friction"},
    {"coefficient", "friction"},
    {"cof", "friction"},
    {"frictioncoefficient", "friction"},
    {"coefficientoffriction", "friction"},
    {"force", "value"},
    {"traction", "value"},
    {"load", "value"},
    {"flux", "value"},
    {"source", "value"},
    {"bodyforce", "value"},
    {"displacement", "value"},
    {"u", "value"},
    {"h", "size"},
    {"lc", "size"},
    {"meshsize", "size"},
    {"elementsize", "size"},
    {"degree", "order"},
    {"centre", "center"},
    {"r", "radius"},
    {"length", "height"},
    {"min", "from"},
    {"max", "to"},
    {"divisions", "cells"},
    {"elements", "cells"},
    {"group", "on"},
    {"part", "on"},
    {"face", "on"},
    {"surface", "on"},
    {"boundary", "on"},
    {"condition", "where"},
    {"region", "where"},
    {"select", "where"},
    {"master", "other"},
    {"target", "other"},
    {"obstacle", "lower"},
    {"psi", "lower"},
    {"lowerbound", "lower"},
    {"upperbound", "upper"},
    {"position", "at"},
    {"coordinates", "at"},
    {"tol", "tolerance"},
    {"eps", "tolerance"},
    {"rtol", "tolerance"},
    {"maxiter", "max_iterations"},
    {"maxit", "max_iterations"},
    {"iterations", "max_iterations"},
    {"levels", "uniform"},
    {"refinements", "uniform"},
    {"steps", "count"},
    {"nthreads", "threads"},
    {"cores", "threads"},
    {"constraint", "fix"},
    {"dirichlet", "fix"},
    {"neumann", "load"},
    {"bc", "fix"},
    {"contact", "obstacle"},
};

std::string plain(std::string_view name) {
  std::string out;
  for (const unsigned char c : name)
    if (c != '_' && c != '-' && c != '\'') out += static_cast<char>(std::tolower(c));
  return out;
}

}  // namespace

std::string_view own_name(std::string_view name) {
  const auto found = std::ranges::find(synonyms, plain(name), &Synonym::other);
  return found == std::end(synonyms) ? std::string_view() : found->own;
}

std::string did_you_mean(std::string_view name, std::span<const std::string> candidates) {
  const std::string_view own = own_name(name);
  if (std::ranges::find(candidates, own) != candidates.end()) return fmt::format(", did you mean '{}'?", own);
  std::size_t best = std::max<std::size_t>(2, name.size() / 2) + 1;
  std::string_view nearest;
  for (const std::string& candidate : candidates) {
    const std::size_t d = edit_distance(name, candidate);
    if (d >= best || d >= std::max(name.size(), candidate.size())) continue;  // nothing of it would be left
    best = d;
    nearest = candidate;
  }
  return nearest.empty() ? std::string() : fmt::format(", did you mean '{}'?", nearest);
}

}  // namespace signorini
