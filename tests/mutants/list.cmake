# The faults. See CMakeLists.txt.

# --- integrals: weights, densities, measures ---------------------------------------------------------------------------
norrsken_mutant(no_mis_weight wave/mis.h
  "fma(ratio, ratio, 1.0f)" "1.0f"
  IN rendering BY "*Plane*rectangle")
norrsken_mutant(bsdf_samples_that_do_not_count wave/shade_surface.h
  "power_heuristic(Float(static_cast<float>(n)), light_pdf, bsdf_samples, Model::pdf_sa(bsdf, wo, wi))"
  "power_heuristic(Float(static_cast<float>(n)), light_pdf, bsdf_samples * Float(0.25f), Model::pdf_sa(bsdf, wo, wi))"
  IN rendering BY "Direct*Split*")
norrsken_mutant(no_light_choice_probability wave/shade_surface.h
  "light.prob * light.sample.pdf_sa" "light.sample.pdf_sa"
  IN rendering BY "*Plane*all_path")
norrsken_mutant(no_light_choice_probability_of_found light/sample_lights.h
  "pdf * light_prob(scene, light, active)" "pdf"
  IN rendering BY "*Plane*all_path")
norrsken_mutant(no_cosine_at_the_surface bsdf/diffuse.h
  "cos_i * kInvPi" "zero_unless(cos_i > 0.0f, kInvPi)"
  IN rendering BY "*Plane*point")
norrsken_mutant(no_cosine_at_the_light light/area_point.h
  "distance2 * sqrt(distance2) / (facing * area)" "distance2 / area"
  IN rendering BY "*Plane*rectangle")
norrsken_mutant(no_area_in_the_density light/flat_area.h
  "1.0f / light.area" "1.0f"
  IN rendering BY "*Plane*rectangle")
norrsken_mutant(no_distance_in_the_measure math/warp.h
  "pdf_area * distance2 / cos_at_surface" "pdf_area / cos_at_surface"
  IN rendering BY "*Plane*rectangle")
norrsken_mutant(no_roulette_weight wave/shade_surface.h
  "throughput * (1.0f / survive)" "throughput"
  IN rendering BY "RussianRoulette*")
norrsken_mutant(roulette_without_eta2 wave/shade_surface.h
  "max_component(throughput) * eta2" "max_component(throughput)"
  IN rendering BY "CoarseBall.Roulette*" SAYING "Expected: .variance. < .0.5.")
norrsken_mutant(no_bsdf_sample_count wave/shade_surface.h
  "throughput * Float(1.0f / static_cast<float>(n))" "throughput"
  IN rendering BY "Direct.SamplesDivide*" SAYING "bsdf_samples: [0-9.e+-]* where")
norrsken_mutant(no_shading_normal_correction wave/shade_particles.h
  "(wo_local.z * dot(wi, surface.normal)) / (dot(wo, surface.normal) * wi_local.z)" "Float(1.0f)"
  IN rendering BY "LookedThrough.*FromTheLight*" SAYING "The difference between got")
norrsken_mutant(no_decompression_of_flux wave/shade_particles.h
  "sample.eta * sample.eta * flux_correction(surface, -hit.ray.direction, wo_local, direction, sample.wi)"
  "flux_correction(surface, -hit.ray.direction, wo_local, direction, sample.wi)"
  IN rendering BY "*LightPaths*glass")
norrsken_mutant(no_light_choice_probability_of_paths light/emit_lights.h
  "1.0f / light_prob(scene, light, active)" "1.0f"
  IN rendering BY "LightPathsOnPlane*")
norrsken_mutant(cosine_of_importance camera/connect.h
  "sqrt(du2 * dv2) * depth * depth * depth" "sqrt(du2 * dv2) * depth * depth * distance"
  IN rendering BY "LightPathsOnPlane*")
norrsken_mutant(sphere_seen_from_behind light/sphere_area.h
  "closest - half_chord" "closest + half_chord"
  IN rendering BY "*Plane*sphere")
norrsken_mutant(cone_of_the_wrong_density math/warp.h
  "Float(1.0f / (2.0f * kPi)) / one_minus_cos" "Float(1.0f / (4.0f * kPi)) / one_minus_cos"
  IN rendering BY "*Plane*sphere")

norrsken_mutant(no_jacobian_of_reflection bsdf/roughconductor.h
  "p.facets.density(m) * p.facets.exact_masking(wo) / (4.0f * wo.z)"
  "p.facets.density(m) * p.facets.exact_masking(wo) / wo.z"
  IN bsdf_model_test BY "*EveryBsdf.WeightIsValueOverDensity/roughconductor*"
  SAYING "The difference between weight.k. [*] pdf and value.k. is")
norrsken_mutant(no_jacobian_of_refraction bsdf/roughdielectric.h
  "ratio * ratio * abs(f.cos_i) * f.cos_o" "ratio * ratio * f.cos_o"
  IN bsdf_model_test BY "*EveryBsdf.DirectionsFollowTheDensity/roughdielectric*"
  SAYING "against the density.s integral")
norrsken_mutant(masking_of_one_direction bsdf/roughplastic.h
  "p.facets.masking(wo, m) * p.facets.masking(wi, m)" "p.facets.masking(wi, m)"
  IN bsdf_model_test BY "*EveryBsdf.Reciprocity/roughplastic*"
  SAYING "The difference between a and b is")
norrsken_mutant(facets_of_one_roughness bsdf/microfacet.h
  "kPi * alpha_u * alpha_v * shape * shape" "kPi * alpha_u * alpha_u * shape * shape"
  IN bsdf_model_test BY "*EveryBsdf.DirectionsFollowTheDensity/roughconductor*"
  SAYING "against the density.s integral")
norrsken_mutant(environment_without_the_sine light/envmap.h
  "mix(patch.weight, at) * Float(map.density_scale) / max(sin_theta, 0x1p-40f)"
  "mix(patch.weight, at) * Float(map.density_scale)"
  IN light_test BY "*EveryLight.DirectionsFollowTheDensity/envmap*"
  SAYING "against the density.s integral")
norrsken_mutant(light_tree_goes_right_like_left light/light_tree.h
  "prob * select(first, p, child_prob(b, a))" "prob * p"
  IN light_test BY "*ManyLights.AreChosenAsOften*"
  SAYING "The difference between double.picked.prob.v. / prob")
norrsken_mutant(light_tree_finds_the_sibling light/light_tree.h
  "prob * child_prob(a, b)" "prob * child_prob(b, a)"
  IN light_test BY "*ManyLights.HaveTheDensity*"
  SAYING "The difference between double.pdf.v. and sampled is")

norrsken_mutant(emission_counted_twice wave/shade_emission.h
  "hit.ray.throughput * emission * weight" "hit.ray.throughput * emission"
  IN rendering BY "*Plane*rectangle")
norrsken_mutant(environment_counted_twice wave/shade_miss.h
  "ray.throughput * radiance * weight" "ray.throughput * radiance"
  IN rendering BY "*Furnace*diffuse" SAYING "The difference between mean and 2 [*] c.shown is")

# --- interfaces --------------------------------------------------------------------------------------------------------
norrsken_mutant(no_compression_of_radiance bsdf/dielectric.h
  "p.specular_transmittance * (inv_eta * inv_eta)" "p.specular_transmittance"
  IN rendering BY "*Refraction*" SAYING "The difference between got.k. and wanted.k. is")
norrsken_mutant(fresnel_of_one_polarisation bsdf/fresnel.h
  "0.5f * fma(r_s, r_s, r_p * r_p)" "r_s * r_s"
  IN rendering BY "*Refraction*" SAYING "The difference between got.k. and wanted.k. is")
norrsken_mutant(no_weight_of_the_chosen_lobe bsdf/plastic.h
  "reflected / specular_prob" "reflected"
  IN rendering BY "*Furnace*plastic" SAYING "The difference between mean and 2 [*] c.shown is")
norrsken_mutant(swapped_eta bsdf/dielectric.h
  "p.get(&Stored::eta)" "1.0f / p.get(&Stored::eta)"
  IN rendering BY "*Refraction*" SAYING "The difference between got.k. and wanted.k. is")
norrsken_mutant(refracted_to_the_wrong_side bsdf/dielectric.h
  "-f.cos_t" "f.cos_t"
  IN rendering BY "*Refraction*" SAYING "The difference between got.k. and wanted.k. is")
norrsken_mutant(refracted_by_the_inverse_eta bsdf/fresnel.h
  "fms(cos_i, inv_eta, cos_t)" "fms(cos_i, eta, cos_t)"
  IN bsdf_model_test BY "*EveryBsdf.WeightIsValueOverDensity/roughdielectric*"
  SAYING "The difference between double.dot.s.wi, s.wi.[.]v. and 1.0 is")
norrsken_mutant(k_in_the_place_of_eta bsdf/roughconductor.h
  "p.get(&Stored::eta)" "p.get(&Stored::k)"
  IN glass_and_metal_test BY "RoughConductor.HasTheReflectance*"
  SAYING "The difference between double.s.weight.r.v. and normal_incidence")

# --- random numbers ----------------------------------------------------------------------------------------------------
norrsken_mutant(off_by_one_dimension wave/shade_surface.h
  "dimension + hit_dimension::kRoulette" "dimension + hit_dimension::kRoulette - 1u"
  IN rendering BY "Direct.*OfRoulette")
norrsken_mutant(lobe_shares_a_dimension wave/sample_bsdf.h
  "dimension + hit_dimension::kBsdfLobe" "dimension + hit_dimension::kBsdfLobe + 1u"
  IN rendering BY "Direct.*OfTheChosenLobe")
norrsken_mutant(replicates_share_points sampler/sampler.h
  "hash(pixel_key, UInt(sample % kReplicates))" "pixel_key"
  IN rendering BY "*ReportedVariance*sobol")

norrsken_mutant(biased_disk math/warp.h
  "ratio * Float(kPi / 4)" "ratio * Float(kPi / 5)"
  IN sampling_test BY "Warp.DiskPreservesArea" SAYING "warp_to_disk: chi-square")
norrsken_mutant(biased_triangle math/warp.h
  "select(upper, u.x, u.y) * 0.5f" "select(upper, u.x, u.y) * 0.4f"
  IN sampling_test BY "Warp.TriangleIsUniform" SAYING "warp_to_triangle: chi-square")
norrsken_mutant(one_sobol_dimension_twice sampler/sobol.h
  "scramble_reversed(second_dimension_reversed(shuffled), hash(seed + 2u))"
  "scramble_reversed(shuffled, hash(seed + 2u))"
  IN sampling_test BY "Sobol.EveryReplicateIsANet" SAYING "Expected equality of these values:\n *cells.size")

# --- geometry ----------------------------------------------------------------------------------------------------------
norrsken_mutant(rays_begin_behind_the_surface wave/surface.h
  "copysign(offset, side)" "-copysign(offset, side)"
  IN rendering BY "*UniformRoom*uniform_sphere")
norrsken_mutant(sides_told_by_the_geometric_normal wave/surface.h
  "side_told_by(shading, hit.ray.direction)" "side_told_by(s.normal, hit.ray.direction)"
  IN rendering BY "CoarseBall.OfGlass*" SAYING "Expected: .mean_of.picture.. >= .0.999.")
norrsken_mutant(rays_begin_on_the_surface wave/surface.h
  "scale * kOffsetUlps" "0.0f"
  IN rendering BY "*UniformRoom*")
norrsken_mutant(shadows_from_behind_the_light accel/planes.h
  "(c.t > 0.0f) & (c.t < t_max)" "c.t > 0.0f"
  IN rendering BY "OracleBox.Lamp*")
norrsken_mutant(no_shadows wave/intersect_shadow.h
  "active & !occluded.at(i, ray.origin, ray.direction, ray.t_max, active)" "active"
  IN rendering BY "OracleBox.Lamp*")
norrsken_mutant(normals_of_instances_turned_like_vectors wave/placed_surface.h
  "from.transposed(s.shading)" "to.vector(s.shading)"
  IN rendering BY "Instances.LookLikeCopies" SAYING "Expected: .differing. < .pixels / 500.")
norrsken_mutant(spheres_hit_at_their_far_side accel/sphere.h
  "tca - thc" "tca + thc"
  IN rendering BY "*Furnace*diffuse" SAYING "The difference between mean and 2 [*] c.shown is")

# --- materials that stand before others --------------------------------------------------------------------------------
norrsken_mutant(blend_weights_swapped bsdf/resolved.h
  "weight_ * select(take, prob, rest)" "weight_ * select(take, rest, prob)"
  IN rendering BY "LookedThrough.ABlend*" SAYING "The difference between got")
norrsken_mutant(mask_inverted bsdf/resolved.h
  "number_ < prob" "number_ > prob"
  IN rendering BY "LookedThrough.AMask*" SAYING "The difference between got")
norrsken_mutant(choice_not_rescaled bsdf/resolved.h
  "select(take, number_ / prob, (number_ - prob) / rest)" "number_"
  IN rendering BY "LookedThrough.*Choices*" SAYING "The difference between got")
norrsken_mutant(infinite_cosine_ratios wave/shade_particles.h
  "max_component(scattered) != 0.0f" "max_component(scattered * factor) != 0.0f"
  IN rendering BY "*DroppedSamples.AreNone*" SAYING "Expected equality of these values:\n *render.sideways")
norrsken_mutant(normal_map_without_a_normal wave/perturbed_frame.h
  "select(lanes, perturbed.frame.n, surface.frame.n)" "surface.frame.n"
  IN rendering BY "LookedThrough.NormalMaps*" SAYING "The difference between got")
norrsken_mutant(twosided_that_mirrors_no_map wave/perturbed_frame.h
  "select(mirrored, Float(-1.0f), Float(1.0f))" "Float(1.0f)"
  IN rendering BY "LookedThrough.WhatStandsAround*" SAYING "The difference between got")
norrsken_mutant(normal_map_without_shadowing wave/perturbed_frame.h
  "zero_unless(cos_theta * cos_inside > 0.0f, shadowing)" "1.0f"
  IN rendering BY "LookedThrough.NormalMaps*" SAYING "The difference between got")

# --- the film ----------------------------------------------------------------------------------------------------------
norrsken_mutant(infinities_are_finite wave/accumulate_film.h
  "largest < 0x7f800000u" "largest <= 0x7f800000u"
  IN rendering BY "*DroppedSamples.AreMissing*" SAYING "Value of: std::isfinite")
norrsken_mutant(dropped_samples_count wave/accumulate_film.h
  "film.counts[pixel + x] - 1" "film.counts[pixel + x]"
  IN rendering BY "*DroppedSamples.AreMissing*" SAYING "lost.channel..i.")
norrsken_mutant(squares_that_are_none wave/accumulate_film.h
  "rounded_to_24_bits(v * v)" "rounded_to_24_bits(v)"
  IN rendering BY "*ReportedVariance*independent")
norrsken_mutant(filter_weights_left_out wave/accumulate_film.h
  "values[i] *= weights[i]" "values[i]"
  IN rendering BY "FilterWeights*" SAYING "The difference between got and wanted is")
norrsken_mutant(splats_in_one_replicate film/splats.cpp
  "(pixel * kLightReplicates + sample % kLightReplicates) * 3" "pixel * kLightReplicates * 3"
  IN rendering BY "LightPathsError*")
norrsken_mutant(samples_begin_at_the_first render/work_plan.cpp
  "origin_ + done" "done"
  IN rendering BY "WorkPlan.GoesOn*" SAYING "Expected equality of these values:\n *n\n")
norrsken_mutant(variance_of_one_too_many film/film.cpp
  "count * (count - 1)" "count * count"
  IN rendering BY "*ReportedVariance*independent")
norrsken_mutant(replicates_of_equal_size film/sample_set.h
  "end % kReplicates > r ? 1u : 0u" "0u"
  IN section_file_test BY "SampleSet.Counts*" SAYING "Expected equality of these values:\n *counts.SampleSet..")
norrsken_mutant(variance_of_one_replicate_too_many film/pixel_estimate.h
  "(count * count - squares)" "(count * count)"
  IN rendering BY "Film.VarianceFromReplicates"
  SAYING "The difference between e.variance and 4.0 is")
norrsken_mutant(unnormalised_filter rfilter/filter.h
  "copysign(scale, half.weight)" "copysign(Float(1.0f), half.weight)"
  IN camera_model_test BY "Filter.AnImage*" SAYING "The difference between row.mean")
norrsken_mutant(sums_that_forget_what_they_round base/exact_sum.h
  "(high - (sum - added)) + (value - added)" "0.0"
  IN section_file_test BY "ExactPlanes.SumsDepend*" SAYING "Expected equality of these values:\n *sum_in_parts")
