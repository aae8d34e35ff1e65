// The assignment as a student would hand it in: the handout's sections in C++, on a copy of its
// scene, without the course framework. It draws its numbers through reference_rand.hpp and writes
// its photons through photon_dump.hpp, so the reference can be asked whether it agrees. On request
// it makes one mistake, or reads the handout in another fair way, to see whether the reference
// notices the one and lets the other pass.
//
// The Cornell box model is by Guedis Cardenas and Morgan McGuire, Williams College 2011, CC BY 3.0.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "photon_dump.hpp"

#define REFERENCE_RAND_REPLACES_RAND
#include "reference_rand.hpp"

namespace {

struct Vec3 {
    float x, y, z;
};

Vec3 vec3(float x, float y, float z) {
    const Vec3 v = {x, y, z};
    return v;
}
Vec3 operator+(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
Vec3 operator-(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
Vec3 operator-(Vec3 v) { return vec3(-v.x, -v.y, -v.z); }
Vec3 operator*(float s, Vec3 v) { return vec3(s * v.x, s * v.y, s * v.z); }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(Vec3 a, Vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
float length(Vec3 v) { return std::sqrt(dot(v, v)); }
Vec3 normalize(Vec3 v) { return (1.0f / length(v)) * v; }

// -------------------------------------------------------------------------------------------------
// What may be done differently

struct Variant {
    // Mistakes
    bool direct_stored, no_offset, uniform_hemisphere, no_square_root, no_absolute_value, nan_frame,
        mean_roulette, red_roulette, no_roulette, transposed_frame, flipped_normal, cube_directions,
        bounce_off_by_one, starts_at_light, transposed_twice, unit_roulette, inverted_roulette,
        along_normal, octant;
    // Readings
    bool literal, axis_z, first_axis_y, exchanged, u2_first, zyx, other_frame;
    float threshold, offset_normal, offset_direction, offset_back, pull_back;
};

const Variant by_default() {
    Variant variant = Variant();
    variant.threshold = 0.99f;
    variant.offset_normal = 1e-5f;
    return variant;
}

struct Choice {
    const char* name;
    bool Variant::* flag;
    const char* what;
};

const Choice mistakes[] = {
    {"direct-stored", &Variant::direct_stored, "the first hit of a path is stored too"},
    {"no-offset", &Variant::no_offset, "the scattered ray starts exactly at the hit"},
    {"uniform-hemisphere", &Variant::uniform_hemisphere, "directions uniform over the hemisphere"},
    {"no-square-root", &Variant::no_square_root, "r = u1"},
    {"no-absolute-value", &Variant::no_absolute_value,
     "n . (1, 0, 0) close to 1, but not to -1; t and b as written"},
    {"nan-frame", &Variant::nan_frame, "the same, t and b normalized"},
    {"mean-roulette", &Variant::mean_roulette, "P_r is the mean of d"},
    {"red-roulette", &Variant::red_roulette, "P_r is the red of d"},
    {"no-roulette", &Variant::no_roulette, "always scatters; wants a small --max-bounces"},
    {"transposed-frame", &Variant::transposed_frame, "t, b, n as rows"},
    {"flipped-normal", &Variant::flipped_normal, "n points to the other side"},
    {"cube-directions", &Variant::cube_directions, "emission without the loop"},
    {"bounce-off-by-one", &Variant::bounce_off_by_one,
     "ends at 0 remaining bounces; wants a small --max-bounces"},
    {"starts-at-light", &Variant::starts_at_light, "the scattered ray starts at the light again"},
    {"transposed-twice", &Variant::transposed_twice, "the transposed matrix is applied twice"},
    {"unit-roulette", &Variant::unit_roulette, "P_r is the largest channel of d / |d|"},
    {"inverted-roulette", &Variant::inverted_roulette, "scatters where the number is above P_r"},
    {"along-normal", &Variant::along_normal, "every photon leaves along n"},
    {"octant", &Variant::octant, "x, y and z in [0, 1)"},
};

const Choice readings[] = {
    {"literal", &Variant::literal, "t and b as written, not normalized"},
    {"axis-z", &Variant::axis_z, "(0, 0, 1) where (1, 0, 0) is parallel"},
    {"first-axis-y", &Variant::first_axis_y, "(0, 1, 0) in equation (7)"},
    {"exchanged", &Variant::exchanged, "t and b exchanged"},
    {"u2-first", &Variant::u2_first, "u2 is drawn before u1"},
    {"zyx", &Variant::zyx, "z is drawn first, x last"},
    {"other-frame", &Variant::other_frame, "t and b as Duff and others have them"},
};

struct Length {
    const char* name;
    float Variant::* length;
    const char* what;
};

const Length lengths[] = {
    {"--threshold", &Variant::threshold, "parallel from this dot product on (0.99)"},
    {"--offset-normal", &Variant::offset_normal, "offset along n (1e-5)"},
    {"--offset-direction", &Variant::offset_direction, "offset along the new direction (0)"},
    {"--offset-back", &Variant::offset_back, "offset back along the ray that came in (0)"},
    {"--pull-back", &Variant::pull_back, "the hit itself, pulled back along the ray (0)"},
};

// -------------------------------------------------------------------------------------------------
// The scene, in world axes (z up)

struct Object {
    const char* name;
    Vec3 diffuse;
};

enum { short_box, right_wall, tall_box, floor_plane, object_count };

const Object objects[object_count] = {
    {"shortBox", {0.725f, 0.71f, 0.68f}},
    {"rightWall", {0.14f, 0.45f, 0.091f}},
    {"tallBox", {0.725f, 0.71f, 0.68f}},
    {"floor", {0.725f, 0.71f, 0.68f}},
};

// In the model's axes, y up.
struct Quad {
    int object;
    Vec3 normal;
    Vec3 corners[4];
};

const Quad quads[] = {
    {short_box,
     {0, 1, 0},
     {{0.53f, 0.60f, 0.75f}, {0.70f, 0.60f, 0.17f}, {0.13f, 0.60f, 0.00f}, {-0.05f, 0.60f, 0.57f}}},
    {short_box,
     {-0.9536f, 0, -0.3011f},
     {{-0.05f, 0, 0.57f}, {-0.05f, 0.60f, 0.57f}, {0.13f, 0.60f, 0.00f}, {0.13f, 0, 0.00f}}},
    {short_box,
     {-0.2964f, 0, 0.9551f},
     {{0.53f, 0, 0.75f}, {0.53f, 0.60f, 0.75f}, {-0.05f, 0.60f, 0.57f}, {-0.05f, 0, 0.57f}}},
    {short_box,
     {0.2858f, 0, -0.9583f},
     {{0.13f, 0, 0.00f}, {0.13f, 0.60f, 0.00f}, {0.70f, 0.60f, 0.17f}, {0.70f, 0, 0.17f}}},
    {short_box,
     {0.9596f, 0, 0.2813f},
     {{0.70f, 0, 0.17f}, {0.70f, 0.60f, 0.17f}, {0.53f, 0.60f, 0.75f}, {0.53f, 0, 0.75f}}},
    {right_wall,
     {-1, 0, 0},
     {{1.00f, 0, -1.04f}, {1.00f, 0, 0.99f}, {1.00f, 1.99f, 0.99f}, {1.00f, 1.99f, -1.04f}}},
    {tall_box,
     {0, 1, 0},
     {{-0.53f, 1.20f, 0.09f},
      {0.04f, 1.20f, -0.09f},
      {-0.14f, 1.20f, -0.67f},
      {-0.71f, 1.20f, -0.49f}}},
    {tall_box,
     {-0.9551f, 0, 0.2964f},
     {{-0.53f, 0, 0.09f}, {-0.53f, 1.20f, 0.09f}, {-0.71f, 1.20f, -0.49f}, {-0.71f, 0, -0.49f}}},
    {tall_box,
     {-0.3011f, 0, -0.9536f},
     {{-0.71f, 0, -0.49f}, {-0.71f, 1.20f, -0.49f}, {-0.14f, 1.20f, -0.67f}, {-0.14f, 0, -0.67f}}},
    {tall_box,
     {0.9551f, 0, -0.2964f},
     {{-0.14f, 0, -0.67f}, {-0.14f, 1.20f, -0.67f}, {0.04f, 1.20f, -0.09f}, {0.04f, 0, -0.09f}}},
    {tall_box,
     {0.3011f, 0, 0.9536f},
     {{0.04f, 0, -0.09f}, {0.04f, 1.20f, -0.09f}, {-0.53f, 1.20f, 0.09f}, {-0.53f, 0, 0.09f}}},
    {floor_plane,
     {0, 1, 0},
     {{-1.01f, 0, 0.99f}, {1.00f, 0, 0.99f}, {1.00f, 0, -1.04f}, {-0.99f, 0, -1.04f}}},
};

const Vec3 light_position = {0.01909f, 0.0101f, 1.77640f};
const Vec3 light_color = {1, 1, 1};

struct Ray {
    Vec3 position, direction;
};

struct Triangle {
    Vec3 corner, edge1, edge2, normal;
    int object;
};

struct Hit {
    float t;
    const Triangle* triangle;
};

Vec3 model_to_world(Vec3 v) { return vec3(v.x, -v.z, v.y); }

std::vector<Triangle> build_scene() {
    std::vector<Triangle> triangles;
    for (const Quad& quad : quads) {
        Vec3 corners[4];
        for (int i = 0; i < 4; ++i) {
            corners[i] = model_to_world(quad.corners[i]);
        }
        for (int i = 1; i <= 2; ++i) {
            const Triangle triangle = {corners[0], corners[i] - corners[0],
                                       corners[i + 1] - corners[0],
                                       normalize(model_to_world(quad.normal)), quad.object};
            triangles.push_back(triangle);
        }
    }
    return triangles;
}

// Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997), two-sided.
//
// The tests ask what is wrong, never what is right: a NaN then passes them all, as it does in the
// course framework, and a frame of NaNs shows as the flood of NaN photons that students see.
bool intersect(const Triangle& triangle, const Ray& ray, float farthest, float& t) {
    const float parallel = 1e-7f;
    const Vec3 p = cross(ray.direction, triangle.edge2);
    const float det = dot(triangle.edge1, p);
    if (std::fabs(det) < parallel) {
        return false;
    }
    const Vec3 s = ray.position - triangle.corner;
    const float u = dot(s, p) / det;
    if (u < 0.0f || u > 1.0f) {
        return false;
    }
    const Vec3 q = cross(s, triangle.edge1);
    const float v = dot(ray.direction, q) / det;
    if (v < 0.0f || u + v > 1.0f) {
        return false;
    }
    t = dot(triangle.edge2, q) / det;
    // Not at 0: there a ray without offset would meet its own triangle for certain, and not by
    // rounding.
    return !(t <= 0.0f || t >= farthest);
}

bool trace(const std::vector<Triangle>& scene, const Ray& ray, Hit& hit) {
    hit.t = std::numeric_limits<float>::max();
    hit.triangle = nullptr;
    for (const Triangle& triangle : scene) {
        float t;
        if (intersect(triangle, ray, hit.t, t)) {
            hit.t = t;
            hit.triangle = &triangle;
        }
    }
    return hit.triangle != nullptr;
}

// -------------------------------------------------------------------------------------------------
// The assignment

struct Photon {
    Vec3 position, intensity, toLightRay;
};

struct Renderer {
    std::vector<Triangle> scene;
    Variant variant;
    photon_dump::PhotonDump recorder;
    std::uint64_t stored[object_count];
};

float random_number() { return static_cast<float>(rand()) / static_cast<float>(RAND_MAX); }

// Photon Emission

Vec3 random_direction(const Variant& variant) {
    float x, y, z, squared;
    // One statement a number: as three arguments of one call they would be drawn in an order of the
    // compiler's choice.
    do {
        x = 2.0f * random_number() - 1.0f;
        y = 2.0f * random_number() - 1.0f;
        z = 2.0f * random_number() - 1.0f;
        if (variant.zyx) {
            std::swap(x, z);
        }
        if (variant.octant) {
            x = 0.5f * (x + 1.0f);
            y = 0.5f * (y + 1.0f);
            z = 0.5f * (z + 1.0f);
        }
        squared = x * x + y * y + z * z;
    } while ((squared > 1.0f && !variant.cube_directions) || squared == 0.0f);
    return normalize(vec3(x, y, z));
}

// Hemisphere Sampling

Vec3 sample_hemisphere(const Variant& variant) {
    float u1 = random_number();
    float u2 = random_number();
    if (variant.u2_first) {
        std::swap(u1, u2);
    }
    float r = std::sqrt(u1);
    float z = std::sqrt(1.0f - u1);
    if (variant.no_square_root) {
        r = u1;
    }
    if (variant.uniform_hemisphere) {
        z = u1;
        r = std::sqrt(1.0f - u1 * u1);
    }
    const float theta = 2.0f * 3.14159265358979f * u2;
    return vec3(r * std::cos(theta), r * std::sin(theta), z);
}

// Hemisphere Ray Transformation

Vec3 to_world(Vec3 local, Vec3 n, const Variant& variant) {
    if (variant.along_normal) {
        return n;
    }
    if (variant.other_frame) {
        // T. Duff and others, "Building an Orthonormal Basis, Revisited" (2017).
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        const Vec3 across = vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
        const Vec3 along = vec3(b, sign + n.y * n.y * a, -n.y);
        return normalize(local.x * across + local.y * along + local.z * n);
    }
    const bool misses_minus_x = variant.no_absolute_value || variant.nan_frame;
    const Vec3 axis = variant.first_axis_y ? vec3(0, 1, 0) : vec3(1, 0, 0);
    const Vec3 other = variant.first_axis_y ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const Vec3 fallback = variant.axis_z ? vec3(0, 0, 1) : other;
    const float closeness = misses_minus_x ? dot(n, axis) : std::fabs(dot(n, axis));
    Vec3 t = cross(n, closeness > variant.threshold ? fallback : axis);
    Vec3 b = cross(n, t);
    if (!variant.literal && !variant.no_absolute_value) {
        t = normalize(t);
        b = cross(n, t);
    }
    if (variant.exchanged) {
        std::swap(t, b);
    }
    if (variant.transposed_twice) {
        local = vec3(dot(t, local), dot(b, local), dot(n, local));
    }
    if (variant.transposed_frame || variant.transposed_twice) {
        return normalize(vec3(dot(t, local), dot(b, local), dot(n, local)));
    }
    return normalize(local.x * t + local.y * b + local.z * n);
}

float reflection_probability(Vec3 d, const Variant& variant) {
    if (variant.no_roulette) {
        return 1.0f;
    }
    if (variant.red_roulette) {
        return d.x;
    }
    if (variant.mean_roulette) {
        return (d.x + d.y + d.z) / 3.0f;
    }
    if (variant.unit_roulette) {
        d = normalize(d);
    }
    return std::fmax(d.x, std::fmax(d.y, d.z));
}

void trace_photon(Renderer& renderer, const Ray& ray, Vec3 intensity, std::vector<char>& path,
                  int remaining_bounces) {
    const Variant& variant = renderer.variant;

    // Photon Storage

    if (remaining_bounces < (variant.bounce_off_by_one ? 1 : 0)) {
        return;
    }
    Hit hit;
    if (!trace(renderer.scene, ray, hit)) {
        return;
    }
    const Vec3 point = ray.position + (hit.t - variant.pull_back) * ray.direction;
    const int object = hit.triangle->object;
    if (path.size() > 1 || variant.direct_stored) {
        const Photon photon = {point, intensity, -ray.direction};
        renderer.recorder.store(photon, object);
        ++renderer.stored[object];
    }

    // Photon Scattering/Absorption

    const bool is_below = random_number() < reflection_probability(objects[object].diffuse, variant);
    if (is_below == variant.inverted_roulette) {
        return;
    }
    const Vec3 n = variant.flipped_normal ? -hit.triangle->normal : hit.triangle->normal;
    const Vec3 direction = to_world(sample_hemisphere(variant), n, variant);
    Vec3 offset = variant.offset_normal * n + variant.offset_direction * direction -
                  variant.offset_back * ray.direction;
    if (variant.no_offset) {
        offset = vec3(0, 0, 0);
    }
    const Vec3 start = variant.starts_at_light ? light_position : point + offset;
    const Ray scattered = {start, direction};
    path.push_back('D');
    trace_photon(renderer, scattered, intensity, path, remaining_bounces - 1);
}

// -------------------------------------------------------------------------------------------------
// The command line

struct Arguments {
    std::uint64_t seed, photons;
    int max_bounces;
    std::string out;
    bool by_surface;
    Variant variant;
};

const char usage[] =
    "usage: by_the_handout --seed S --photons N [--out FILE.csv] [--by-surface] [--max-bounces B]\n"
    "                      [--mistake NAME] [--reading NAME] [--LENGTH X]\n";

void print_choices(const char* title, const Choice* begin, const Choice* end) {
    std::fprintf(stderr, "%s\n", title);
    for (const Choice* choice = begin; choice != end; ++choice) {
        std::fprintf(stderr, "  %-23s %s\n", choice->name, choice->what);
    }
}

void print_usage() {
    std::fputs(usage, stderr);
    print_choices("mistakes:", std::begin(mistakes), std::end(mistakes));
    print_choices("readings:", std::begin(readings), std::end(readings));
    std::fprintf(stderr, "lengths:\n");
    for (const Length& length : lengths) {
        std::fprintf(stderr, "  %-23s %s\n", length.name, length.what);
    }
}

bool parse_number(const std::string& text, std::uint64_t largest, std::uint64_t& number) {
    std::istringstream in(text);
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos &&
           (in >> number) && number <= largest;
}

bool set_length(const std::string& name, const std::string& value, Variant& variant) {
    for (const Length& length : lengths) {
        if (name == length.name) {
            std::istringstream in(value);
            return !(in >> variant.*(length.length)).fail() && in.eof();
        }
    }
    return false;
}

bool choose(const std::string& name, const Choice* begin, const Choice* end, Variant& variant) {
    for (const Choice* choice = begin; choice != end; ++choice) {
        if (name == choice->name) {
            variant.*(choice->flag) = true;
            return true;
        }
    }
    return false;
}

bool parse(int argc, char** argv, Arguments& arguments) {
    bool has_seed = false, has_photons = false;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        if (option == "--by-surface") {
            arguments.by_surface = true;
            continue;
        }
        const std::string value = i + 1 < argc ? argv[++i] : "";
        bool good = true;
        if (option == "--seed") {
            good = has_seed =
                parse_number(value, std::numeric_limits<std::uint64_t>::max(), arguments.seed);
        } else if (option == "--photons") {
            // The largest count up to which every count is a float: the intensity shall be rounded
            // only once.
            good = has_photons = parse_number(value, 1u << 24, arguments.photons);
        } else if (option == "--max-bounces") {
            std::uint64_t bounces = 0;
            good = parse_number(value, 1000, bounces);
            arguments.max_bounces = static_cast<int>(bounces);
        } else if (option == "--out") {
            good = !value.empty();
            arguments.out = value;
        } else if (option == "--mistake") {
            good = choose(value, std::begin(mistakes), std::end(mistakes), arguments.variant);
        } else if (option == "--reading") {
            good = choose(value, std::begin(readings), std::end(readings), arguments.variant);
        } else if (!set_length(option, value, arguments.variant)) {
            std::fprintf(stderr, "by_the_handout: no option %s %s\n", option.c_str(),
                         value.c_str());
            return false;
        }
        if (!good) {
            std::fprintf(stderr, "by_the_handout: %s does not take \"%s\"\n", option.c_str(),
                         value.c_str());
            return false;
        }
    }
    if (!has_seed || !has_photons) {
        std::fprintf(stderr, "by_the_handout: --seed and --photons are needed\n");
        return false;
    }
    return true;
}

} // namespace

int main(int argc, char** argv) {
    Arguments arguments = {};
    arguments.max_bounces = 1000;
    arguments.variant = by_default();
    if (!parse(argc, argv, arguments)) {
        print_usage();
        return 2;
    }

    Renderer renderer = {};
    renderer.scene = build_scene();
    renderer.variant = arguments.variant;
    const float emitted = static_cast<float>(arguments.photons);
    const Vec3 intensity =
        vec3(light_color.x / emitted, light_color.y / emitted, light_color.z / emitted);
    for (std::uint64_t i = 0; i < arguments.photons; ++i) {
        reference_rand::begin_photon(arguments.seed, i);
        renderer.recorder.begin_photon(i);
        const Ray ray = {light_position, random_direction(arguments.variant)};
        std::vector<char> path(1, 'L');
        trace_photon(renderer, ray, intensity, path, arguments.max_bounces);
    }

    std::printf("emitted %llu\n", static_cast<unsigned long long>(arguments.photons));
    std::printf("stored %llu\n", static_cast<unsigned long long>(renderer.recorder.size()));
    if (arguments.by_surface) {
        for (int object : {floor_plane, right_wall, short_box, tall_box}) {
            std::printf("%s %llu\n", objects[object].name,
                        static_cast<unsigned long long>(renderer.stored[object]));
        }
    }
    return arguments.out.empty() || renderer.recorder.write(arguments.out) ? 0 : 1;
}
