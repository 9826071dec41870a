#pragma once
#include <ctime>
#include <string>

namespace ream {

/// Eight letters and digits at random, without those that are easily taken for one another when read aloud or
/// typed.
std::string random_id();

/// The code of a study's participant, "K7-F3M": drawn at random, without vowels and what is easily taken for
/// another.
std::string random_participant_code();

/// A moment as "2025-03-01T12:00:00Z".
std::string utc_text(std::time_t time);
/// The present one.
std::string utc_now();
/// The present one to the millisecond, "2025-03-01T12:00:00.250Z"; within this process each is later than the
/// one before, however quickly they follow.
std::string utc_now_in_order();

}  // namespace ream
