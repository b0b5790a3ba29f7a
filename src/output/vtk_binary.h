#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tourmaline::output {

/// VTK's compressed inline form of an array, as XML files hold it in a DataArray of format "binary"
/// with header_type UInt64 and vtkZLibDataCompressor: the base64 text of
///   (number of blocks, bytes in a block, bytes in the last block if it is shorter, else 0,
///    compressed bytes of each block)
/// followed by the base64 text of the compressed blocks, one behind the other. The blocks are
/// compressed by a few threads; the text does not depend on how many. Throws MachineError when
/// there is no memory.
std::string vtk_binary(std::span<const std::byte> array);

}  // namespace tourmaline::output
