#include "core/io/convergence.hpp"

#include <fmt/format.h>

namespace signorini {

std::string convergence_row(const IterationRecord& record) {
  return fmt::format("{:9} {:11.3e} {:11.3e} {:18.10e} {:8} {:8}", record.iteration, record.residual,
                     record.algebraic_error, record.energy, record.contact_nodes, record.changed);
}

std::string convergence_table(const std::vector<IterationRecord>& history) {
  std::string table = fmt::format("{:>9} {:>11} {:>11} {:>18} {:>8} {:>8}\n", "iteration", "residual", "error",
                                  "energy", "contact", "changed");
  for (const IterationRecord& record : history) table += convergence_row(record) + '\n';
  return table;
}

std::string convergence_csv(const std::vector<const Summary*>& steps) {
  std::string csv = "step,iteration,residual,algebraic_error,energy,contact_nodes,changed\n";
  for (std::size_t step = 0; step < steps.size(); ++step)
    for (const IterationRecord& record : steps[step]->history)
      csv += fmt::format("{},{},{},{},{},{},{}\n", step + 1, record.iteration, record.residual, record.algebraic_error,
                         record.energy, record.contact_nodes, record.changed);
  return csv;
}

}  // namespace signorini
