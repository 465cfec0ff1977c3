// Every camera: the one place that a new one is included in.
#pragma once

#include "camera/orthographic.h"
#include "camera/perspective.h"
#include "camera/thinlens.h"
