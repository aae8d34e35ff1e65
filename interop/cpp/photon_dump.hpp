// Writes photons as the CSV that `photon-mapping compare` reads.
//
// From a finished photon map, whatever container it is:
//
//   photon_dump::dump(photonMap, "submission.csv");
//
// or, knowing which photon and which bounce each record is, so that lists can be compared record by
// record:
//
//   photon_dump::PhotonDump recorder;
//   recorder.begin_photon(i);             // before photon i, counted from 0 over all lights
//   recorder.store(photon);               // wherever the photon map receives one
//   recorder.store(photon, 3);            // or so, where the object that was hit is known
//   recorder.write("submission.csv");
//
// A photon is any type with the members `position` and `intensity` (vectors with .x .y .z or [0]
// [1] [2]) and `toLightRay` (such a vector, or a ray with GetRayDirection()).
//
// Columns: x y z in world coordinates; intensity_r intensity_g intensity_b, the light's color
// divided by the photons it emitted; to_light_x to_light_y to_light_z, against the photon's flight;
// photon, its number; bounce, 1 at the second hit of a path, since the first is not stored;
// surface, the object that was hit, by its place in the model file from 0. The last three are
// written only if every record has them.

#ifndef PHOTON_DUMP_HPP
#define PHOTON_DUMP_HPP

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

// Shared by photon_dump.hpp and reference_rand.hpp, whichever comes first.
#ifndef PHOTON_NUMBERS
#define PHOTON_NUMBERS
namespace photon_numbers {
// How many numbers reference_rand.hpp gave this thread's photon, if it gives any.
struct Drawn {
    bool is_counted;
    std::uint64_t numbers;
};
inline Drawn& drawn() {
    static thread_local Drawn of_thread = {false, 0};
    return of_thread;
}
} // namespace photon_numbers
#endif

namespace photon_dump {
namespace detail {

struct Triple {
    float x, y, z;
};

// `photon-mapping check` reads photons with these overloads, too. They differ in their last
// parameter only, int being the better match for 0: names go before indices, because vector types
// that have both need not agree on what [] means.
template <class Vector>
auto to_triple(const Vector& v, int) -> decltype(static_cast<void>(v.z), Triple()) {
    const Triple triple = {static_cast<float>(v.x), static_cast<float>(v.y),
                           static_cast<float>(v.z)};
    return triple;
}

template <class Vector>
auto to_triple(const Vector& v, long) -> decltype(static_cast<void>(v[2]), Triple()) {
    const Triple triple = {static_cast<float>(v[0]), static_cast<float>(v[1]),
                           static_cast<float>(v[2])};
    return triple;
}

// By value, so that a ray whose getter is not const will do as well.
template <class Ray>
auto direction(Ray ray, int) -> decltype(static_cast<void>(ray.GetRayDirection()), Triple()) {
    return to_triple(ray.GetRayDirection(), 0);
}

template <class Vector>
auto direction(const Vector& v, long) -> decltype(to_triple(v, 0)) {
    return to_triple(v, 0);
}

const int no_surface = -1;

struct Record {
    Triple position, intensity, to_light;
    std::uint64_t photon;
    std::uint32_t bounce;
    int surface;
};

template <class Photon>
Record to_record(const Photon& photon) {
    Record record;
    record.position = to_triple(photon.position, 0);
    record.intensity = to_triple(photon.intensity, 0);
    record.to_light = direction(photon.toLightRay, 0);
    record.photon = 0;
    record.bounce = 0;
    record.surface = no_surface;
    return record;
}

// Nine significant digits bring every float back to the bit.
inline std::string to_text(float number) {
    std::uint32_t bits;
    static_assert(sizeof bits == sizeof number, "float must have 32 bits");
    std::memcpy(&bits, &number, sizeof bits);
    // By bits, because -ffast-math lets the compiler take isnan() for false; and by hand, because
    // libraries disagree on the spelling ("-nan", "nan(ind)").
    if ((bits & 0x7f800000u) == 0x7f800000u) {
        if ((bits & 0x007fffffu) != 0) {
            return "nan";
        }
        return (bits >> 31) != 0 ? "-inf" : "inf";
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(number));
    // A program that has set a locale may get a decimal comma, which would be one column too many.
    for (char* c = text; *c != '\0'; ++c) {
        if (*c == ',') {
            *c = '.';
        }
    }
    return text;
}

inline std::string to_text(const Triple& t) {
    return to_text(t.x) + ',' + to_text(t.y) + ',' + to_text(t.z);
}

inline bool complain(const std::string& path, const char* what) {
    std::fprintf(stderr, "photon_dump: %s %s: %s\n", what, path.c_str(), std::strerror(errno));
    return false;
}

class CsvFile {
public:
    // Binary, so that lines end alike on every system.
    explicit CsvFile(const std::string& path)
        : path_(path), file_(std::fopen(path.c_str(), "wb")), good_(true) {}
    ~CsvFile() {
        if (file_ != nullptr) {
            std::fclose(file_);
        }
    }
    CsvFile(const CsvFile&) = delete;
    CsvFile& operator=(const CsvFile&) = delete;

    bool is_open() const { return file_ != nullptr || complain(path_, "cannot create"); }

    void line(const std::string& text) {
        good_ = good_ && std::fwrite(text.data(), 1, text.size(), file_) == text.size() &&
                std::fputc('\n', file_) != EOF;
    }

    // A full disk may show only when the last buffer goes out.
    bool close() {
        good_ = std::fclose(file_) == 0 && good_;
        file_ = nullptr;
        return good_ || complain(path_, "cannot write");
    }

private:
    std::string path_;
    std::FILE* file_;
    bool good_;
};

inline std::string header() {
    return "x,y,z,intensity_r,intensity_g,intensity_b,to_light_x,to_light_y,to_light_z";
}

inline std::string columns(const Record& record) {
    return to_text(record.position) + ',' + to_text(record.intensity) + ',' +
           to_text(record.to_light);
}

} // namespace detail

// Everything that can be iterated over. False, with a line on stderr, when the file cannot be
// written.
template <class Photons>
bool dump(const Photons& photons, const std::string& path) {
    detail::CsvFile file(path);
    if (!file.is_open()) {
        return false;
    }
    file.line(detail::header());
    for (const auto& photon : photons) {
        file.line(detail::columns(detail::to_record(photon)));
    }
    return file.close();
}

// Keeps its own copies, in the order of storing: a kd-tree gives its photons back in another one.
// For one thread.
class PhotonDump {
public:
    PhotonDump()
        : photon_(0), bounce_(0), has_begun_(false), has_photons_(true), has_surfaces_(true),
          is_warned_(false) {}

    void begin_photon(std::uint64_t i) {
        photon_ = i;
        bounce_ = 0;
        has_begun_ = true;
    }

    template <class Photon>
    void store(const Photon& photon) {
        store(photon, detail::no_surface);
    }

    template <class Photon>
    void store(const Photon* photon) {
        store(*photon);
    }

    template <class Photon>
    void store(const Photon* photon, int surface) {
        store(*photon, surface);
    }

    template <class Photon>
    void store(const Photon& photon, int surface) {
        detail::Record record = detail::to_record(photon);
        record.photon = photon_;
        record.bounce = ++bounce_;
        record.surface = surface;
        notice_numbers();
        // One record that lacks a value costs the column: a made-up value would be compared like a
        // true one.
        has_photons_ = has_photons_ && has_begun_;
        has_surfaces_ = has_surfaces_ && surface != detail::no_surface;
        records_.push_back(record);
    }

    std::size_t size() const { return records_.size(); }

    // False, with a line on stderr, when the file cannot be written.
    bool write(const std::string& path) const {
        detail::CsvFile file(path);
        if (!file.is_open()) {
            return false;
        }
        file.line(detail::header() + (has_photons_ ? ",photon,bounce" : "") +
                  (has_surfaces_ ? ",surface" : ""));
        for (const detail::Record& record : records_) {
            std::string line = detail::columns(record);
            if (has_photons_) {
                line += ',' + std::to_string(record.photon) + ',' + std::to_string(record.bounce);
            }
            if (has_surfaces_) {
                line += ',' + std::to_string(record.surface);
            }
            file.line(line);
        }
        return file.close();
    }

private:
    // The emission takes three numbers, and each bounce takes three. One bounce less is asked for:
    // a mistaken program stores the first hit, too.
    void notice_numbers() {
        const photon_numbers::Drawn& drawn = photon_numbers::drawn();
        if (is_warned_ || !drawn.is_counted || drawn.numbers >= 3 * std::uint64_t(bounce_)) {
            return;
        }
        std::fprintf(stderr,
                     "photon_dump: photon %llu is stored at bounce %u after %llu numbers from "
                     "rand(), too few: glm::linearRand, <random> and other files draw from elsewhere\n",
                     static_cast<unsigned long long>(photon_), static_cast<unsigned>(bounce_),
                     static_cast<unsigned long long>(drawn.numbers));
        is_warned_ = true;
    }

    std::vector<detail::Record> records_;
    std::uint64_t photon_;
    std::uint32_t bounce_;
    bool has_begun_;
    bool has_photons_;
    bool has_surfaces_;
    bool is_warned_;
};

} // namespace photon_dump

#endif // PHOTON_DUMP_HPP
