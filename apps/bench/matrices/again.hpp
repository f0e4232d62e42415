#pragma once

namespace signorini::bench {

/// Prints what a second solve of S3 costs, with other bounds and from the last solution, over the first one.
void print_again(bool quick);

}  // namespace signorini::bench
