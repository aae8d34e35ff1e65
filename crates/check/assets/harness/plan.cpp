// Reading a plan: see plan.hpp.

#include "plan.hpp"

#include <cstdio>
#include <sstream>
#include <string>
#include <unistd.h>

#include "recorder.hpp"

namespace photon_check {
namespace {

glm::vec3 read_vector(std::istream& in) {
    glm::vec3 v;
    in >> v.x >> v.y >> v.z;
    return v;
}

} // namespace

bool read_plan(const char* path, Plan& plan) {
    const int descriptor = open_plan(path);
    std::FILE* const file = descriptor >= 0 ? fdopen(descriptor, "r") : nullptr;
    if (file == nullptr) {
        return false;
    }
    std::vector<char> text(1 << 20);
    text.resize(std::fread(text.data(), 1, text.size(), file));
    std::fclose(file);
    std::istringstream lines(std::string(text.begin(), text.end()));
    std::string line;
    MeshObject* object = nullptr;
    while (std::getline(lines, line)) {
        std::istringstream in(line);
        std::string item;
        in >> item;
        if (item == "scene") {
            plan.scenes.push_back(std::make_shared<Scene>());
            plan.lights.emplace_back();
        } else if (item == "object") {
            std::string name;
            in >> name;
            object = plan.scenes.back()->AddObject(name, read_vector(in));
        } else if (item == "triangle") {
            glm::vec3 corners[3];
            for (glm::vec3& corner : corners) {
                corner = read_vector(in);
            }
            plan.scenes.back()->AddTriangle(object, corners, read_vector(in));
        } else if (item == "light") {
            LightData light;
            light.position = read_vector(in);
            light.color = read_vector(in);
            plan.lights.back().push_back(light);
        } else {
            Step step = Step();
            in >> step.scene >> step.calls;
            step.kind = item == "emit"           ? Step::emit
                        : item == "trace"        ? Step::trace
                        : item == "around-light" ? Step::around_light
                        : item == "around"       ? Step::around
                                                 : Step::whole;
            if (step.kind == Step::trace || step.kind == Step::around) {
                std::size_t rays = 0;
                in >> step.path >> step.remaining >> rays;
                for (std::size_t i = 0; i < rays; ++i) {
                    const glm::vec3 from = read_vector(in);
                    Ray ray;
                    ray.SetRayPosition(from);
                    ray.SetRayDirection(read_vector(in));
                    step.rays.push_back(ray);
                }
            }
            if (step.kind != Step::whole && step.kind != Step::around_light) {
                std::size_t count = 0;
                in >> count;
                step.numbers.resize(count);
                for (std::uint32_t& number : step.numbers) {
                    in >> number;
                }
            }
            plan.steps.push_back(step);
        }
        if (!in) {
            return false;
        }
    }
    return true;
}

} // namespace photon_check
