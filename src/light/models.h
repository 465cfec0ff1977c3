// Every kind of light: the one place that a new one is included in.
#pragma once

#include "light/analytic_area.h"
#include "light/constant.h"
#include "light/directional.h"
#include "light/directionalarea.h"
#include "light/envmap.h"
#include "light/flat_area.h"
#include "light/point.h"
#include "light/projector.h"
#include "light/sphere_area.h"
#include "light/spot.h"
