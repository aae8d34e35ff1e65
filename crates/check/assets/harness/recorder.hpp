// What the harness sees of a submission, and how it tells `photon-mapping check`.
//
// Messages go to a pipe, in pieces. First comes a random key of 8 bytes. The key and a u32, the
// length, stand before every piece: what a submission writes to the pipe by itself lacks the key.
// Each message starts with a letter; numbers are as they lie in memory. `messages.rs` reads them.
//
//   B u32            the step with this number begins
//   N                one call of the student's code begins
//   R 6 f32          GenerateRandomPhotonRay returned this position and direction
//   T 6 f32, u8, f32, u16, u16
//                    Scene::Trace was called with this position and direction; bit 0: it met
//                    something, bit 1: a state was given; the distance, the object, the triangle
//   P 9 f32          a photon was stored: position, intensity, direction to the light
//   E u32, u32       the call ended; the numbers it drew, and how often it took an old seed
//   X u16, bytes     the call ended with an exception, which says this
//   W 44 bytes       a photon of the whole run was stored: a row of a photon list
//   C 4 u64          the whole run ended: numbers drawn, photons emitted, rays traced, hits after
//                    the first of a path
//   A 720 u32        the directions of a step around x, y or z, which come in this order; 720 parts
//                    of the circle
//   L                the whole run stored more than anyone reads
//   U                the submission's functions have another signature; the step is left out
//   S u8             something worth saying happened for the first time; see Notice
//   O                the stack overflowed
//   M                the program crashes with its memory used up
//   Q                the step ended
//   Z                all steps ended
#pragma once

#include <cstddef>
#include <cstdint>

namespace photon_check {

enum Notice : std::uint8_t {
    random_device_read = 1,
    process_started = 2,
    not_guarded = 3,
};

// What is told: single calls (the steps for one section), directions around an axis, or only stored
// photons (the whole run).
enum class Mode : std::uint8_t { silent, events, around, whole };
void set_mode(Mode mode);

void begin_step(std::uint32_t number);
void end_step();
void begin_call();
void end_call();
void end_call_with_exception(const char* what);
void on_emitted(const float (&position_and_direction)[6]);
void on_trace(const float (&position_and_direction)[6], bool met, bool has_state, float t,
              int object, int triangle);
void on_insert(const float (&values)[9]);
void end_whole_run();

// In around.cpp: directions are counted for `seconds` of processor time, and then told.
const std::size_t around_bins = 720;
void begin_around(double seconds);
// Whether one more call is wanted. None is where every call draws `numbers_of_direction` from the
// reference: then single calls tell how directions follow from them.
bool wants_more_around(std::uint64_t numbers_of_direction);
void count_around(const float* direction, int axis);
void count_second_ray(const float* direction);
void end_around();
void tell_around(const std::uint32_t (&counts)[around_bins]);

void other_signature();
void notice(Notice what);
void all_steps_ended();

// In guard.cpp.
void watch_the_stack();
void give_processor_time(unsigned seconds);
bool system_calls_are_filtered();
// The file descriptor of the plan, which was opened before files were refused.
int open_plan(const char* path);

// Sends what is still in memory.
void flush();

// Moves the pipe from file descriptor 3 to a random one. Nothing happens the second time.
void open_pipe();
// Tell it from a signal handler.
void stack_overflowed();
void memory_ran_out();

// The photon of the whole run that is traced from here on.
void begin_photon(std::uint64_t number);

// In random.cpp: goes to the start of a photon's random numbers. First come `scripted` ones, each a
// multiple of 2^-24.
void begin_numbers(std::uint64_t seed, std::uint64_t photon, const std::uint32_t* scripted,
                   std::size_t count);
std::uint64_t numbers_drawn();
// How often a seed was set that had been set since seeds were forgotten.
std::uint32_t seeds_again();
void forget_seeds();

} // namespace photon_check
