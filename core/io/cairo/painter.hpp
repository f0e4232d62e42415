#pragma once
#include "core/io/picture.hpp"

namespace signorini {

void draw_convergence(const std::filesystem::path& picture, const std::vector<IterationRecord>& history);
void draw_panels(const std::filesystem::path& picture, const std::vector<Panel>& panels);

}  // namespace signorini
