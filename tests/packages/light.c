// SPDX-License-Identifier: Apache-2.0
// Prints the red light that arrives from above at a position, E(n) / pi with n = +Y: light FILE X Y Z
#include <stdio.h>
#include <stdlib.h>

#include <tetralight/runtime/tetralight.h>

int main(int count, char** arguments) {
    tetralight_error error;
    tetralight_volume* volume = NULL;
    tetralight_light light;
    float position[3];
    int axis;
    if (count != 5) return 2;
    for (axis = 0; axis < 3; ++axis) position[axis] = (float)atof(arguments[2 + axis]);
    if (tetralight_open(arguments[1], &volume, &error) != TETRALIGHT_OK ||
        tetralight_query(volume, position, NULL, &light, &error) != TETRALIGHT_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    // SHAr . (0, 1, 0, 1) + SHC.r (x^2 - y^2); the products of SHBr are 0.
    printf("%.6g\n", (double)(light.packed[1] + light.packed[3] - light.packed[24]));
    tetralight_close(volume);
    return 0;
}
