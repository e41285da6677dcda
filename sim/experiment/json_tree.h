#pragma once
#include "constraints/json_tree.h"
