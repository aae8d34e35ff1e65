// What a submission may do that is worse than a wrong picture: the name of the program says what.
#include "common/Scene/Lights/Point/PointLight.h"

#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

#include "name.h"

static const std::string deed = name_of_program();

struct AtStart
{
    AtStart()
    {
        if (deed == "static-exit") std::exit(0);
        if (deed == "static-loop") for (volatile int i = 0;; i = 1) {}
    }
} atStart;

static int recurse(int depth)
{
    volatile char page[4096];
    page[0] = static_cast<char>(depth);
    return recurse(depth + 1) + page[0];
}

void PointLight::ComputeSampleRays(std::vector<Ray>&, glm::vec3, glm::vec3) const {}
float PointLight::ComputeLightAttenuation(glm::vec3) const { return 1.f; }

void PointLight::GenerateRandomPhotonRay(Ray& ray) const
{
    if (deed == "loop") for (volatile int i = 0;; i = 1) {}
    static bool has_slept = false;
    if (deed == "sleep" && !has_slept) { has_slept = true; sleep(2); }
    if (deed == "crash") { volatile int* nowhere = nullptr; *nowhere = 1; }
    if (deed == "abort") std::abort();
    if (deed == "exit") std::exit(0);
    if (deed == "kill") { syscall(SYS_kill, getppid(), 9); syscall(SYS_kill, -1, 9); std::abort(); }
    if (deed == "forks") for (int i = 0; i < 20; ++i) { fork(); syscall(SYS_fork); }
    if (deed == "socket" && socket(AF_INET, SOCK_STREAM, 0) >= 0) std::abort();
    if (deed == "file" && std::fopen("plan.txt", "w") != nullptr) std::abort();
    if (deed == "read" && std::fopen("/etc/passwd", "r") != nullptr) std::abort();
    if (deed == "output") for (;;) std::puts(std::string(1 << 16, 'x').c_str());
    if (deed == "memory") {
        std::vector<std::unique_ptr<char[]>> all;
        for (;;) all.emplace_back(new char[64 << 20]);
    }
    if (deed == "daemon" && syscall(SYS_fork) == 0) {
        setsid();
        for (;;) sleep(1000);
    }
    if (deed == "fill") {
        std::FILE* file = std::fopen("/tmp/photon-mapping-check-fill", "w");
        if (file != nullptr) std::abort();
    }
    if (deed == "recursion") recurse(0);
    if (deed == "throw") throw std::runtime_error("on purpose\nbob: correct");
    if (deed == "forge") {
        const char told[] = "QZ";
        if (write(3, told, 2) == 2) std::abort();
    }
    if (deed == "forge-all") {
        const std::string told(64, 'Z');
        for (int i = 3; i < 256; ++i) if (write(i, told.data(), told.size()) > 0) continue;
    }
    if (deed == "print") std::puts("hello");

    float x, y, z, sum;
    do {
        x = 2.f * ((float)rand() / RAND_MAX) - 1.f;
        y = 2.f * ((float)rand() / RAND_MAX) - 1.f;
        z = 2.f * ((float)rand() / RAND_MAX) - 1.f;
        sum = x * x + y * y + z * z;
        // In one step alone: to fill so much memory takes long.
        if (deed == "malloc" && sum == 0.f) for (;;) {
            // Volatile, or clang leaves both calls out.
            void* volatile memory = std::malloc(64 << 20);
            std::memset(memory, 1, 64 << 20);
        }
    } while (sum > 1.f || sum == 0.f);
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::normalize(glm::vec3(x, y, z)));
}
