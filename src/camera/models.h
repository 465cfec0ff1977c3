// Every camera and meter: the one place that a new one is included in.
#pragma once

#include "camera/distant.h"
#include "camera/irradiancemeter.h"
#include "camera/orthographic.h"
#include "camera/perspective.h"
#include "camera/radiancemeter.h"
#include "camera/thinlens.h"
