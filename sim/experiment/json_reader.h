#pragma once
#include "constraints/json_reader.h"
