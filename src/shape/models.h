// Every shape with a formula of its own: the one place that a new one is included in.
#pragma once

#include "shape/bsplinecurve.h"
#include "shape/cylinder.h"
#include "shape/disk.h"
#include "shape/linearcurve.h"
#include "shape/sdfgrid.h"
