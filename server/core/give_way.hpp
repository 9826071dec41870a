#pragma once

namespace ream {

/// From here on the calling thread takes no processor from a haptic loop or a viewer's stream.
void give_way();

}  // namespace ream
