// Every phase function.
#pragma once

#include "medium/hg.h"
#include "medium/isotropic.h"
#include "medium/rayleigh.h"
#include "medium/sggx.h"
#include "medium/tabphase.h"
