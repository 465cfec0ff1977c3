// Every scattering model, and what stands before others: the one place that a new model is included in.
#pragma once

#include "bsdf/absorb.h"
#include "bsdf/blendbsdf.h"
#include "bsdf/bumpmap.h"
#include "bsdf/conductor.h"
#include "bsdf/dielectric.h"
#include "bsdf/diffuse.h"
#include "bsdf/mask.h"
#include "bsdf/normalmap.h"
#include "bsdf/null.h"
#include "bsdf/plastic.h"
#include "bsdf/principled.h"
#include "bsdf/principledthin.h"
#include "bsdf/roughconductor.h"
#include "bsdf/roughdielectric.h"
#include "bsdf/roughplastic.h"
#include "bsdf/thindielectric.h"
