#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/crew.hpp"

namespace signorini {

/// An array as VTK's vtkZLibDataCompressor stores it, with numbers of 64 bits in its header: how many blocks, their
/// size, that of the last one where it is smaller, the packed sizes, and then the blocks, each a zlib stream.
/// In pieces that follow each other, for one string of all would need as much memory once more. The result does not
/// depend on the number of threads.
/// @param worthwhile blocks of which a sample shrinks to more than this part of its size (the digits of a smooth
///   solution, say) are stored as they are, which takes a twentieth of the time
std::vector<std::string> pack_vtu(std::span<const char> bytes, double worthwhile, Crew& crew);

}  // namespace signorini
