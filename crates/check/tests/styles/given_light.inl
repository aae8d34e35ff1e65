void PointLight::ComputeSampleRays(std::vector<Ray>& output, glm::vec3 origin, glm::vec3 normal) const
{
    origin += LARGE_EPSILON * normal;
    const glm::vec3 me = glm::vec3(GetPosition());
    output.emplace_back(origin, me - origin, glm::length(me - origin));
}

float PointLight::ComputeLightAttenuation(glm::vec3 origin) const
{
    return 1.f;
}
