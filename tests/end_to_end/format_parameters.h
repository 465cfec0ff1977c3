// The parameters that each plugin of the format takes, those of its base classes too: what Mitsuba 3.9.1 does not call
// unreferenced. Left out are whole nodes (bitmap, rfilter, srf), and parameters that it always refuses.
#pragma once

namespace norrsken::testing {

struct FormatPlugin {
  const char* kind;
  const char* name;
  const char* parameters;
};

inline constexpr FormatPlugin kFormat[] = {
    {"bsdf", "diffuse", "reflectance"},
    {"bsdf", "conductor", "eta k material specular_reflectance"},
    {"bsdf", "roughconductor", "alpha alpha_u alpha_v distribution eta k material sample_visible specular_reflectance"},
    {"bsdf", "dielectric", "ext_ior int_ior specular_reflectance specular_transmittance"},
    {"bsdf", "thindielectric", "ext_ior int_ior specular_reflectance specular_transmittance"},
    {"bsdf", "roughdielectric",
     "alpha alpha_u alpha_v distribution ext_ior int_ior sample_visible specular_reflectance "
     "specular_transmittance"},
    {"bsdf", "null", ""},
    {"bsdf", "plastic", "diffuse_reflectance ext_ior int_ior nonlinear specular_reflectance"},
    {"bsdf", "roughplastic",
     "alpha alpha_u alpha_v diffuse_reflectance distribution ext_ior int_ior nonlinear "
     "sample_visible specular_reflectance"},
    {"bsdf", "principled",
     "anisotropic base_color clearcoat clearcoat_gloss clearcoat_sampling_rate "
     "diffuse_reflectance_sampling_rate eta flatness main_specular_sampling_rate metallic "
     "roughness sheen sheen_tint spec_tint spec_trans specular"},
    {"bsdf", "principledthin",
     "anisotropic base_color diff_trans diffuse_reflectance_sampling_rate "
     "diffuse_transmittance_sampling_rate eta flatness roughness sheen sheen_tint spec_tint "
     "spec_trans specular_reflectance_sampling_rate specular_transmittance_sampling_rate"},
    {"bsdf", "mask", "opacity"},
    {"bsdf", "blendbsdf", "weight"},
    {"bsdf", "bumpmap", "flip_invalid_normals scale use_shadowing_function"},
    {"bsdf", "normalmap", "flip_invalid_normals normalmap use_shadowing_function"},
    {"bsdf", "twosided", "allow_transmission"},
    {"texture", "checkerboard", "color0 color1 to_uv"},
    {"texture", "bitmap", "accel filename filter_type format raw to_uv wrap_mode"},
    {"texture", "mesh_attribute", "name scale"},
    {"shape", "sphere", "center flip_normals radius silhouette_sampling_weight to_world"},
    {"shape", "cylinder", "flip_normals p0 p1 radius silhouette_sampling_weight to_world"},
    {"shape", "rectangle", "face_normals flip_normals silhouette_sampling_weight to_world"},
    {"shape", "disk", "flip_normals silhouette_sampling_weight to_world"},
    {"shape", "cube", "face_normals flip_normals silhouette_sampling_weight to_world"},
    {"shape", "obj", "face_normals filename flip_normals flip_tex_coords silhouette_sampling_weight to_world"},
    {"shape", "ply", "face_normals filename flip_normals flip_tex_coords silhouette_sampling_weight to_world"},
    {"shape", "sdfgrid", "filename normals silhouette_sampling_weight to_world"},
    {"shape", "serialized", "face_normals filename flip_normals shape_index silhouette_sampling_weight to_world"},
    {"shape", "linearcurve", "filename silhouette_sampling_weight to_world"},
    {"shape", "bsplinecurve", "filename silhouette_sampling_weight to_world"},
    {"shape", "shapegroup", "silhouette_sampling_weight to_world"},
    {"shape", "instance", "silhouette_sampling_weight to_world"},
    {"emitter", "area", "radiance sampling_weight"},
    {"emitter", "directionalarea", "radiance sampling_weight"},
    {"emitter", "point", "intensity position sampling_weight to_world"},
    {"emitter", "spot", "beam_width cutoff_angle intensity sampling_weight to_world"},
    {"emitter", "directional", "direction irradiance sampling_weight to_world"},
    {"emitter", "constant", "radiance sampling_weight to_world"},
    {"emitter", "envmap", "filename mis_compensation sampling_weight scale to_world"},
    {"emitter", "projector", "focal_length fov fov_axis irradiance sampling_weight scale to_world"},
    {"sensor", "perspective",
     "far_clip focal_length focus_distance fov fov_axis near_clip principal_point_offset_x "
     "principal_point_offset_y shutter_close shutter_open to_world"},
    {"sensor", "orthographic", "far_clip focus_distance near_clip shutter_close shutter_open to_world"},
    {"sensor", "thinlens",
     "aperture_radius far_clip focal_length focus_distance fov fov_axis near_clip shutter_close "
     "shutter_open to_world"},
    {"film", "hdrfilm",
     "banner compensate component_format crop_height crop_offset_x crop_offset_y crop_width "
     "file_format height pixel_format sample_border width"},
    {"rfilter", "box", ""},
    {"rfilter", "tent", "radius"},
    {"rfilter", "gaussian", "stddev"},
    {"rfilter", "mitchell", "B C"},
    {"rfilter", "catmullrom", ""},
    {"rfilter", "lanczos", "lobes"},
    {"sampler", "independent", "sample_count seed"},
    {"sampler", "ldsampler", "sample_count seed"},
    {"sampler", "multijitter", "jitter sample_count seed"},
    {"sampler", "stratified", "jitter sample_count seed"},
    {"sampler", "orthogonal", "jitter sample_count seed strength"},
    {"medium", "homogeneous", "albedo has_spectral_extinction sample_emitters scale sigma_t"},
    {"medium", "heterogeneous", "albedo has_spectral_extinction sample_emitters scale sigma_t"},
    {"phase", "isotropic", ""},
    {"phase", "hg", "g"},
    {"phase", "rayleigh", ""},
    {"phase", "sggx", "S"},
    {"phase", "tabphase", "values"},
    {"phase", "blendphase", "weight"},
    {"volume", "constvolume", "to_world value"},
    {"volume", "gridvolume", "accel filename filter_type max_value raw to_world use_grid_bbox wrap_mode"},
    {"integrator", "path", "block_size hide_emitters max_depth rr_depth samples_per_pass timeout"},
    {"integrator", "direct",
     "block_size bsdf_samples emitter_samples hide_emitters samples_per_pass shading_samples "
     "timeout"},
    {"integrator", "ptracer", "hide_emitters max_depth rr_depth samples_per_pass timeout"},
    {"integrator", "depth", "block_size hide_emitters samples_per_pass timeout"},
    {"integrator", "moment", "block_size hide_emitters samples_per_pass timeout"},
    {"integrator", "aov", "aovs block_size hide_emitters samples_per_pass timeout"},
    {"integrator", "volpath", "block_size hide_emitters max_depth rr_depth samples_per_pass timeout"},
    {"integrator", "volpathmis",
     "block_size hide_emitters max_depth rr_depth samples_per_pass timeout use_spectral_mis"},
    {"spectrum", "blackbody", "temperature wavelength_max wavelength_min"},
    {"spectrum", "d65", "color scale"},
    {"spectrum", "irregular", "value values wavelengths"},
    {"spectrum", "rawconstant", "value"},
    {"spectrum", "regular", "value values wavelength_max wavelength_min"},
    {"spectrum", "srgb", "color unbounded"},
    {"spectrum", "uniform", "value wavelength_max wavelength_min"},
};

}  // namespace norrsken::testing
