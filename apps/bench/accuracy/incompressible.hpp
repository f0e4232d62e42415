#pragma once

namespace signorini::bench {

/// The tables of docs/measured/rubber.md: elements for nearly incompressible material, in Markdown.
void print_incompressible(bool quick);

}  // namespace signorini::bench
