#pragma once

using Sample = float;
