// The recorder: see recorder.hpp.

#include "recorder.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace photon_check {
namespace {

// The longest list that `grade` reads.
const std::uint64_t most_records = 5000000;

// A key and a length stand before every piece. The submission knows neither the key nor the
// number of the pipe.
const std::size_t head_size = sizeof(std::uint64_t) + sizeof(std::uint32_t);

int pipe_to_check = -1;
std::uint64_t key = 0;
char buffer[head_size + (1 << 16)];
std::size_t used = head_size;
Mode mode = Mode::silent;
std::uint64_t calls_of_step = 0;
std::uint64_t drawn_before_call = 0;
std::uint32_t seeds_before_call = 0;
std::uint64_t drawn_before_run = 0;
std::uint64_t photons = 0;
std::uint64_t rays = 0;
std::uint64_t records = 0;
std::uint64_t bounced = 0;
std::uint64_t photon = 0;
std::uint16_t hits_of_photon = 0;
std::uint16_t last_object = 0;
bool noticed[8];

void put_bytes(const void* bytes, std::size_t size) {
    if (used + size > sizeof buffer) {
        flush();
    }
    std::memcpy(buffer + used, bytes, size);
    used += size;
}

// What happened in the first calls is told at once: it shows where one does not end.
void flush_early() {
    if (mode == Mode::events && calls_of_step <= 16) {
        flush();
    }
}

void put(char letter) { put_bytes(&letter, 1); }
template <class Number>
void put_number(Number number) {
    put_bytes(&number, sizeof number);
}

void write_all(const char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t now = write(pipe_to_check, bytes, size);
        if (now > 0) {
            bytes += now;
            size -= static_cast<std::size_t>(now);
        } else if (errno != EINTR) {
            // Nobody listens any more.
            _exit(3);
        }
    }
}

void write_head(char* to, std::size_t size) {
    const std::uint32_t length = static_cast<std::uint32_t>(size);
    std::memcpy(to, &key, sizeof key);
    std::memcpy(to + sizeof key, &length, sizeof length);
}

// From a signal handler, which must not touch the buffer.
void tell_at_once(char letter) {
    char piece[head_size + 1];
    write_head(piece, 1);
    piece[head_size] = letter;
    write_all(piece, sizeof piece);
}

} // namespace

void open_pipe() {
    if (pipe_to_check >= 0) {
        return;
    }
    std::uint64_t random[2] = {0, 0};
    const int source = open("/dev/urandom", O_RDONLY);
    if (source >= 0) {
        if (read(source, random, sizeof random) < 0) {
            _exit(3);
        }
        close(source);
    }
    pipe_to_check = fcntl(3, F_DUPFD, 16 + static_cast<int>(random[0] % 200));
    close(3);
    key = random[1];
    write_all(reinterpret_cast<const char*>(&key), sizeof key);
}

void flush() {
    if (used > head_size) {
        write_head(buffer, used - head_size);
        write_all(buffer, used);
        used = head_size;
    }
}

void stack_overflowed() { tell_at_once('O'); }
void memory_ran_out() { tell_at_once('M'); }

void set_mode(Mode new_mode) {
    mode = new_mode;
    calls_of_step = photons = rays = records = bounced = 0;
    forget_seeds();
    drawn_before_run = numbers_drawn();
}

void begin_step(std::uint32_t number) {
    put('B');
    put_number(number);
    flush();
}

void end_step() {
    put('Q');
    flush();
}

void begin_call() {
    if (mode == Mode::around) {
        return;
    }
    ++calls_of_step;
    put('N');
    drawn_before_call = numbers_drawn();
    seeds_before_call = seeds_again();
}

void end_call() {
    if (mode == Mode::around) {
        return;
    }
    put('E');
    put_number(static_cast<std::uint32_t>(numbers_drawn() - drawn_before_call));
    put_number(seeds_again() - seeds_before_call);
}

void end_call_with_exception(const char* what) {
    const std::size_t length = strnlen(what, 500);
    put('X');
    put_number(static_cast<std::uint16_t>(length));
    put_bytes(what, length);
}

void on_emitted(const float (&position_and_direction)[6]) {
    put('R');
    put_bytes(position_and_direction, sizeof position_and_direction);
}

void on_trace(const float (&position_and_direction)[6], bool met, bool has_state, float t,
              int object, int triangle) {
    ++rays;
    if (mode == Mode::events) {
        put('T');
        put_bytes(position_and_direction, sizeof position_and_direction);
        put_number(static_cast<std::uint8_t>((met ? 1 : 0) | (has_state ? 2 : 0)));
        put_number(t);
        put_number(static_cast<std::uint16_t>(object));
        put_number(static_cast<std::uint16_t>(triangle));
        flush_early();
    } else if (mode == Mode::around && has_state) {
        count_second_ray(position_and_direction + 3);
    }
    if (met && has_state) {
        bounced += hits_of_photon > 0;
        ++hits_of_photon;
        last_object = static_cast<std::uint16_t>(object);
    }
}

void on_insert(const float (&values)[9]) {
    if (mode == Mode::events) {
        put('P');
        put_bytes(values, sizeof values);
        flush_early();
    } else if (mode == Mode::whole) {
        if (++records > most_records) {
            put('L');
            flush();
            _exit(0);
        }
        put('W');
        put_bytes(values, sizeof values);
        put_number(static_cast<std::uint32_t>(photon));
        // The first hit of a path has not bounced yet.
        put_number(static_cast<std::uint16_t>(hits_of_photon == 0 ? 0 : hits_of_photon - 1));
        put_number(last_object);
    }
}

void begin_photon(std::uint64_t number) {
    ++photons;
    photon = number;
    hits_of_photon = 0;
}

void end_whole_run() {
    put('C');
    put_number(numbers_drawn() - drawn_before_run);
    put_number(photons);
    put_number(rays);
    put_number(bounced);
}

void tell_around(const std::uint32_t (&counts)[around_bins]) {
    put('A');
    put_bytes(counts, sizeof counts);
}

void other_signature() { put('U'); }

void notice(Notice what) {
    if (!noticed[what]) {
        noticed[what] = true;
        put('S');
        put_number(static_cast<std::uint8_t>(what));
    }
}

void all_steps_ended() {
    put('Z');
    flush();
}

} // namespace photon_check
