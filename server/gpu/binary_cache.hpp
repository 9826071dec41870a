#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ream::gpu {

/// $REAM_CACHE, else $XDG_CACHE_HOME/ream, else ~/.cache/ream; empty (nothing is cached) when none is known.
std::filesystem::path cache_folder();

/// A built program kept from an earlier run, found by everything it depends on: `key` holds device, driver,
/// options and source. Nothing when there is none or the file is damaged.
std::optional<std::vector<std::byte>> load_binary(const std::string& key);

/// Keeps a built program. A cache that cannot be written is no error: the next run builds again.
void store_binary(const std::string& key, const std::vector<std::byte>& binary);

}  // namespace ream::gpu
