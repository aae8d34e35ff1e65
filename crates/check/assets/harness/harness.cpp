// Runs the two handed-in files: on small scenes with known answers, one section of the handout at a
// time, and on the handout's scene. What they do is recorded (recorder.hpp) and judged elsewhere.
//
//   harness PLAN FIRST END SECONDS WHOLE
//
// carries out the steps of the file PLAN from number FIRST to before END. A step on a small scene
// has SECONDS of processor time, the whole run has WHOLE; SIGPROF ends what takes longer.
//
// This file is compiled with -fno-access-control, since TracePhoton is private.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <unistd.h>
#include <vector>

#include "common/Rendering/Renderer/Photon/Photon.h"
#include "common/Rendering/Renderer/Photon/PhotonMappingRenderer.h"
#include "common/Scene/Lights/Point/PointLight.h"
#include "common/Scene/Scene.h"

#include "plan.hpp"
#include "recorder.hpp"

namespace {

using namespace photon_check;

const std::uint64_t seed = 148;
const glm::vec3 intensity(1e-3f, 2e-3f, 3e-3f);

// The student's light, which tells the recorder that another photon begins.
class RecordedLight : public PointLight {
public:
    RecordedLight() : next(0) {}
    void GenerateRandomPhotonRay(Ray& ray) const override {
        begin_numbers(seed, next, nullptr, 0);
        begin_photon(next);
        ++next;
        PointLight::GenerateRandomPhotonRay(ray);
    }

private:
    mutable std::uint64_t next;
};

// Thrown where InitializeRenderer asks for more rays than it was told to.
struct EnoughRays {};

// Stands in for the light of paths that start there: it emits the step's rays.
class ScriptedLight : public Light {
public:
    explicit ScriptedLight(const Step& of_step) : calls(0), step(of_step) {}
    void ComputeSampleRays(std::vector<Ray>&, glm::vec3, glm::vec3) const override {}
    float ComputeLightAttenuation(glm::vec3) const override { return 1.f; }
    void GenerateRandomPhotonRay(Ray& ray) const override {
        if (calls > 0) {
            end_call();
        }
        if (calls == step.calls) {
            throw EnoughRays();
        }
        begin_call();
        begin_numbers(seed, calls, step.numbers.data(), step.numbers.size());
        ray = step.rays[calls++ % step.rays.size()];
    }

    mutable std::uint64_t calls;

private:
    const Step& step;
};

// The rest runs the student's code. An exception ends a step, not the program.
template <class Call>
bool guarded(Call call) {
    try {
        call();
        return true;
    } catch (const std::exception& error) {
        end_call_with_exception(error.what());
    } catch (...) {
        end_call_with_exception("an exception that is no std::exception");
    }
    return false;
}

std::shared_ptr<PhotonMappingRenderer> make_renderer(std::shared_ptr<Scene> scene) {
    return std::make_shared<PhotonMappingRenderer>(scene, std::make_shared<ColorSampler>());
}

// Members that a student may have renamed are used where they are there. The overloads differ in
// their last parameter; int is the better match for 0.
template <class Renderer>
auto set_photons(Renderer& renderer, int count, int)
    -> decltype(static_cast<void>(renderer.SetNumberOfDiffusePhotons(count))) {
    renderer.SetNumberOfDiffusePhotons(count);
}
template <class Renderer>
auto set_photons(Renderer& renderer, int count, long)
    -> decltype(static_cast<void>(renderer.diffusePhotonNumber = count)) {
    renderer.diffusePhotonNumber = count;
}

template <class Renderer>
void set_photons(Renderer&, int, ...) {}

template <class Renderer>
auto set_bounces(Renderer& renderer, int count, int)
    -> decltype(static_cast<void>(renderer.maxPhotonBounces = count), true) {
    renderer.maxPhotonBounces = count;
    return true;
}
template <class Renderer>
bool set_bounces(Renderer&, int count, long) {
    // From here on, the step does not ask how paths end.
    return count >= 50;
}

template <class Renderer>
auto trace_photon(Renderer& renderer, const Step& step, std::uint64_t call, int)
    -> decltype(renderer.TracePhoton(renderer.diffuseMap, std::declval<Ray*>(), intensity,
                                     std::declval<std::vector<char>&>(), 1.f, step.remaining),
                true) {
    Ray ray = step.rays[call % step.rays.size()];
    std::vector<char> path(step.path, 'D');
    path[0] = 'L';
    renderer.TracePhoton(renderer.diffuseMap, &ray, intensity, path, 1.f, step.remaining);
    return true;
}
template <class Renderer>
bool trace_photon(Renderer&, const Step&, std::uint64_t, long) {
    return false;
}

template <class Renderer>
auto can_call(Renderer& renderer, int)
    -> decltype(renderer.TracePhoton(renderer.diffuseMap, std::declval<Ray*>(), intensity,
                                     std::declval<std::vector<char>&>(), 1.f, 0),
                true) {
    return true;
}
template <class Renderer>
bool can_call(Renderer&, long) {
    return false;
}

template <class Renderer>
auto clear_map(Renderer& renderer, int) -> decltype(static_cast<void>(renderer.diffuseMap.clear())) {
    renderer.diffuseMap.clear();
}
template <class Renderer>
void clear_map(Renderer&, long) {}

void place(PointLight& light, const LightData& data) {
    light.SetPosition(data.position);
    light.SetLightColor(data.color);
}

void run_emit(const Plan& plan, const Step& step) {
    PointLight light;
    place(light, plan.lights[step.scene][0]);
    const Light& as_light = light;
    set_mode(Mode::events);
    for (std::uint64_t i = 0; i < step.calls; ++i) {
        begin_call();
        begin_numbers(seed, i, step.numbers.data(), step.numbers.size());
        if (!guarded([&] {
                Ray ray;
                as_light.GenerateRandomPhotonRay(ray);
                const glm::vec3 from = glm::vec3(ray.GetPosition());
                const glm::vec3 towards = ray.GetRayDirection();
                const float values[6] = {from.x, from.y, from.z, towards.x, towards.y, towards.z};
                on_emitted(values);
            })) {
            return;
        }
        end_call();
    }
}

// Whether paths of the step that start at the light went through InitializeRenderer, as in a run:
// TracePhoton may need what is done there before.
template <class Renderer>
bool trace_from_light(Renderer& renderer, Scene& scene, const Step& step) {
    if (step.path != 1 || !set_bounces(renderer, step.remaining, 0)) {
        return false;
    }
    const std::shared_ptr<ScriptedLight> light = std::make_shared<ScriptedLight>(step);
    light->SetLightColor(glm::vec3(1.f));
    scene.AddLight(light);
    set_photons(renderer, static_cast<int>(step.calls), 0);
    guarded([&] {
        try {
            renderer.InitializeRenderer();
            if (light->calls > 0) {
                end_call();
            }
        } catch (const EnoughRays&) {
        }
    });
    return light->calls > 0;
}

void run_trace(const Plan& plan, const Step& step) {
    std::shared_ptr<PhotonMappingRenderer> renderer;
    const std::shared_ptr<Scene> scene = std::make_shared<Scene>(*plan.scenes[step.scene]);
    if (!guarded([&] { renderer = make_renderer(scene); })) {
        return;
    }
    set_mode(Mode::events);
    if (trace_from_light(*renderer, *scene, step)) {
        return;
    }
    if (!can_call(*renderer, 0)) {
        other_signature();
        return;
    }
    // As if the path had started with all bounces before it.
    set_bounces(*renderer, step.remaining + static_cast<int>(step.path) - 1, 0);
    for (std::uint64_t i = 0; i < step.calls; ++i) {
        begin_call();
        begin_numbers(seed, i, step.numbers.data(), step.numbers.size());
        if (!guarded([&] { trace_photon(*renderer, step, i, 0); })) {
            return;
        }
        end_call();
        clear_map(*renderer, 0);
    }
}

void run_around_light(const Plan& plan, const Step& step, double seconds) {
    PointLight light;
    place(light, plan.lights[step.scene][0]);
    const Light& as_light = light;
    begin_numbers(seed, 0, nullptr, 0);
    begin_around(seconds);
    guarded([&] {
        // Angles in polar coordinates take two numbers.
        for (std::uint64_t i = 0; i < step.calls && wants_more_around(2); ++i) {
            Ray ray;
            as_light.GenerateRandomPhotonRay(ray);
            const glm::vec3 towards = ray.GetRayDirection();
            for (int axis = 0; axis < 3; ++axis) {
                count_around(&towards[0], axis);
            }
        }
    });
    end_around();
}

void run_around(const Plan& plan, const Step& step, double seconds) {
    const std::shared_ptr<Scene> scene = std::make_shared<Scene>(*plan.scenes[step.scene]);
    begin_numbers(seed, 0, nullptr, 0);
    begin_around(seconds);
    guarded([&] {
        const std::shared_ptr<PhotonMappingRenderer> renderer = make_renderer(scene);
        // One number is for the roulette.
        for (std::uint64_t i = 0; i < step.calls && wants_more_around(3); ++i) {
            if (!trace_photon(*renderer, step, i, 0)) {
                return;
            }
            clear_map(*renderer, 0);
        }
    });
    end_around();
}

void run_whole(const Plan& plan, const Step& step) {
    const std::shared_ptr<Scene> scene = std::make_shared<Scene>(*plan.scenes[step.scene]);
    for (const LightData& data : plan.lights[step.scene]) {
        const std::shared_ptr<RecordedLight> light = std::make_shared<RecordedLight>();
        place(*light, data);
        scene->AddLight(light);
    }
    guarded([&] {
        const std::shared_ptr<PhotonMappingRenderer> renderer = make_renderer(scene);
        set_photons(*renderer, static_cast<int>(step.calls), 0);
        set_mode(Mode::whole);
        renderer->InitializeRenderer();
        end_whole_run();
    });
}

} // namespace

int main(int argc, char** argv) {
    open_pipe();
    watch_the_stack();
    Plan plan;
    if (argc != 6 || !read_plan(argv[1], plan)) {
        std::fprintf(stderr, "harness: expected a plan, two numbers of steps and two times\n");
        return 2;
    }
    if (!system_calls_are_filtered()) {
        notice(not_guarded);
    }
    const std::size_t end = std::min<std::size_t>(std::stoul(argv[3]), plan.steps.size());
    for (std::size_t i = std::stoul(argv[2]); i < end; ++i) {
        const Step& step = plan.steps[i];
        begin_step(static_cast<std::uint32_t>(i));
        const char* const seconds = argv[step.kind == Step::whole ? 5 : 4];
        give_processor_time(static_cast<unsigned>(std::stoul(seconds)));
        // A third of it is far from its end.
        const double around_seconds = std::stoul(seconds) / 3.0;
        switch (step.kind) {
        case Step::emit:
            run_emit(plan, step);
            break;
        case Step::trace:
            run_trace(plan, step);
            break;
        case Step::around_light:
            run_around_light(plan, step, around_seconds);
            break;
        case Step::around:
            run_around(plan, step, around_seconds);
            break;
        case Step::whole:
            run_whole(plan, step);
            break;
        }
        set_mode(Mode::silent);
        end_step();
    }
    all_steps_ended();
    // What the student's destructors would do is of no interest.
    _exit(0);
}
