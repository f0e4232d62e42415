#include "methods/renewal.hpp"

#include <fmt/format.h>

#include "core/solver/option_table.hpp"

namespace signorini {

Renewal::Renewal(const SolverOptions& options) : when_(choice<When>(options, &SolverOptions::renew)) {}

void Renewal::next(const std::vector<double>& follows, std::vector<double>& frozen) const {
  for (std::size_t i = 0; i < frozen.size(); ++i)
    frozen[i] = part_ == 1 ? follows[i] : frozen[i] + part_ * (follows[i] - frozen[i]);
}

void Renewal::add(double natural_residual) {
  ++cycles_;
  if (natural_residual <= enough * least_) {
    least_ = natural_residual;
    idle_ = 0;
  } else if (++idle_ == patience) {
    part_ *= 0.5;
    idle_ = 0;
  }
}

std::string Renewal::stuck() const {
  if (part_ >= least_part) return "";
  return fmt::format(
      "friction does not come to rest, though its bound was damped down to a part of {:g}: for so large a coefficient "
      "of "
      "friction there may be no solution, or several",
      2 * part_);
}

}  // namespace signorini
