// Compiled once per instruction set.
#include "model_kernels.h"

#include "wave/schedule.h"

namespace norrsken::NORRSKEN_ISA {
namespace {

/// Registers of paths one after the other, as in a stage, whose compaction keeps the compiler from making several
/// registers one: without this it turns the one-lane loops of the simplest models into four lanes.
template <class Body>
NORRSKEN_INLINE void for_each_register(const ModelArrays& a, Body body) {
  for (std::uint32_t i = 0; i < a.count; i += kLanes) {
    body(i, first_lanes(a.count - i));
    asm volatile("" ::: "memory");
  }
}

NORRSKEN_INLINE Vec3f load3(const float* const (&v)[3], std::uint32_t i) {
  return {load(v[0] + i), load(v[1] + i), load(v[2] + i)};
}
NORRSKEN_INLINE void store3(float* const* out, std::uint32_t i, const Vec3f& v) {
  store(out[0] + i, v.x), store(out[1] + i, v.y), store(out[2] + i, v.z);
}
NORRSKEN_INLINE void store3(float* const* out, std::uint32_t i, const Color& v) {
  store(out[0] + i, v.r), store(out[1] + i, v.g), store(out[2] + i, v.b);
}

NORRSKEN_INLINE void store_sample(const ModelArrays& a, std::uint32_t i, const BsdfSample& s) {
  store3(a.out, i, s.wi);
  store3(a.out + 3, i, select(s.valid, s.weight, black()));
  store(a.out[6] + i, s.pdf_sa);
  store(a.out[7] + i, s.eta);
}

template <class Model, BsdfOperation kOperation>
void run_bsdf(const ModelArrays& a) {
  for_each_register(a, [&](std::uint32_t i, Mask active) {
    const TexturePoint point{};
    const auto p = Model::load({*a.scene, load_uint(a.place + i), point, active});
    const Vec3f wo = load3(a.wo, i), wi = load3(a.wi, i);
    const auto sample = [&] {
      return Model::sample(p, wo, Model::kUsesLobe ? load(a.u[2] + i) : Float(0.0f),
                           {load(a.u[0] + i), load(a.u[1] + i)});
    };
    if constexpr (kOperation == BsdfOperation::evaluate) store3(a.out, i, Model::evaluate(p, wo, wi));
    if constexpr (kOperation == BsdfOperation::pdf_sa) store(a.out[0] + i, Model::pdf_sa(p, wo, wi));
    if constexpr (kOperation == BsdfOperation::sample) store_sample(a, i, sample());
    if constexpr (kOperation == BsdfOperation::hit) {
      BsdfSample s = sample();
      if (!Model::kDelta) s.weight = fma(Model::evaluate(p, wo, wi), Model::pdf_sa(p, wo, wi), s.weight);
      store_sample(a, i, s);
    }
  });
}

template <class Model>
void run_light_sample(const ModelArrays& a) {
  for_each_register(a, [&](std::uint32_t i, Mask active) {
    const Light light = gather_light(a.scene->lights, load_uint(a.place + i), active);
    const LightSample s =
        Model::sample(*a.scene, light, load3(a.reference, i), {load(a.u[0] + i), load(a.u[1] + i)}, active);
    store3(a.out, i, s.point);
    store3(a.out + 3, i, select(s.valid, s.radiance, {Float(0.0f), Float(0.0f), Float(0.0f)}));
    store(a.out[6] + i, s.pdf_sa);
  });
}

template <class Model>
void run_light_pdf_sa(const ModelArrays& a) {
  for_each_register(a, [&](std::uint32_t i, Mask active) {
    const Light light = gather_light(a.scene->lights, load_uint(a.place + i), active);
    store(a.out[0] + i,
          Model::pdf_sa(*a.scene, light, load3(a.reference, i), load3(a.wi, i), load(a.distance + i), active));
  });
}

template <class Model, BsdfOperation kOperation>
constexpr ModelKernels::Kernel bsdf_kernel() {
  constexpr bool kAsked =
      !Model::kDelta || (kOperation != BsdfOperation::evaluate && kOperation != BsdfOperation::pdf_sa);
  if constexpr (kAsked) return run_bsdf<Model, kOperation>;
  return nullptr;
}

template <class Model, bool kDelta>
constexpr ModelKernels::Kernel light_pdf_kernel() {
  if constexpr (!kDelta) return run_light_pdf_sa<Model>;
  return nullptr;
}

}  // namespace

extern const ModelKernels kModelKernels;
const ModelKernels kModelKernels = {NORRSKEN_ISA_NAME,
                                    kLanes,
                                    {
                                        {},  // absorb
#define NORRSKEN_BSDF(kind, Model)                                                             \
  {bsdf_kernel<Model, BsdfOperation::evaluate>(), bsdf_kernel<Model, BsdfOperation::pdf_sa>(), \
   bsdf_kernel<Model, BsdfOperation::sample>(), bsdf_kernel<Model, BsdfOperation::hit>()},
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
                                    },
                                    {
#define NORRSKEN_LIGHT(kind, Model, is_delta) {run_light_sample<Model>, light_pdf_kernel<Model, is_delta>()},
#include "lists/light.def"
#undef NORRSKEN_LIGHT
                                    }};

}  // namespace norrsken::NORRSKEN_ISA
