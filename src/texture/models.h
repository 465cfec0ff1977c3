// Every texture: the one place that a new one is included in.
#pragma once

#include "texture/bitmap.h"
#include "texture/checkerboard.h"
#include "texture/mesh_attribute.h"
