#pragma once

namespace signorini::bench {

/// Prints cycles and seconds of bodies that touch each other, solved as one problem and in turns.
void print_bodies(bool quick);

}  // namespace signorini::bench
