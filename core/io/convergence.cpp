#include "core/io/convergence.hpp"

#include <fmt/format.h>

namespace signorini {

std::string convergence_heading() {
  return fmt::format("{:>9} {:>11} {:>11} {:>18} {:>8} {:>8}", "iteration", "residual", "error", "energy", "contact",
                     "changed");
}

std::string convergence_row(const IterationRecord& record) {
  return fmt::format("{:9} {:11.3e} {:11.3e} {:18.10e} {:8} {:8}", record.iteration, record.residual,
                     record.algebraic_error, record.energy, record.contact_nodes, record.changed);
}

std::string convergence_table(const std::vector<IterationRecord>& history) {
  std::string table = convergence_heading() + '\n';
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

std::string phases_csv(const std::vector<const Summary*>& steps) {
  std::string csv = "step,iteration,level,vectors,critical,contact_0,contact_1,contact_2,changed,renewed,seconds\n";
  for (std::size_t step = 0; step < steps.size(); ++step)
    for (const IterationRecord& record : steps[step]->history)
      for (std::size_t k = 0; k < record.levels.size(); ++k) {
        const LevelReport& level = record.levels[k];
        csv += fmt::format("{},{},{},{},{},{},{},{},{:.3e}\n", step + 1, record.iteration, steps[step]->level_number(k),
                           level.vectors, level.critical, fmt::join(level.contact, ","), level.changed, level.renewed,
                           level.seconds);
      }
  return csv;
}

}  // namespace signorini
