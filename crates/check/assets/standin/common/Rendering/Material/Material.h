// Stand-in: a material that only reflects diffusely, as all of this assignment do.
#pragma once

#include "common/common.h"

class Material {
public:
    Material() : diffuse(0.f) {}
    explicit Material(glm::vec3 response) : diffuse(response) {}
    virtual ~Material() {}

    virtual glm::vec3 GetBaseDiffuseReflection() const { return diffuse; }
    virtual glm::vec3 GetBaseSpecularReflection() const { return glm::vec3(0.f); }
    virtual glm::vec3 GetBaseTransmittance() const { return glm::vec3(0.f); }

    virtual bool HasDiffuseReflection() const { return diffuse != glm::vec3(0.f); }
    virtual bool HasSpecularReflection() const { return false; }
    bool IsReflective() const { return false; }
    bool IsTransmissive() const { return false; }
    float GetReflectivity() const { return 0.f; }
    float GetTransmittance() const { return 0.f; }
    float GetIOR() const { return 1.f; }
    virtual glm::vec3 ComputeNonLightDependentBRDF(const class Renderer*,
                                                   const struct IntersectionState&) const {
        return glm::vec3(0.f);
    }
    virtual glm::vec3 ComputeDiffuse(const struct IntersectionState&, const glm::vec3& lightColor,
                                     float towardsLight, float) const {
        return diffuse * lightColor * glm::max(towardsLight, 0.f);
    }
    virtual glm::vec3 ComputeSpecular(const struct IntersectionState&, const glm::vec3&, float,
                                      float) const {
        return glm::vec3(0.f);
    }
    virtual glm::vec3 ComputeBRDF(const struct IntersectionState&, const glm::vec3& lightColor,
                                  const class Ray&, const class Ray&, float attenuation,
                                  bool = true, bool = true) const {
        return diffuse * lightColor * attenuation;
    }

private:
    glm::vec3 diffuse;
};
