// One program for all mistakes: the file "mistake" in the working folder says which one it makes.
#pragma once

#include <cstdio>

enum Mistake {
    none,
    direct_stored,
    no_offset,
    uniform_hemisphere,
    no_square_root,
    cube_directions,
    mean_roulette,
    red_roulette,
    no_roulette,
    transposed_frame,
    flipped_normal,
    nan_frame,
    bounce_off_by_one,
    inverted_roulette,
    along_normal,
    start_not_moved,
    first_bounce_only,
    literal,
    long_offset,
    exchanged,
    octant_and_mean,
};

inline Mistake mistake() {
    static int number = -1;
    if (number < 0) {
        number = 0;
        std::FILE* file = std::fopen("mistake", "r");
        if (file != nullptr) {
            if (std::fscanf(file, "%d", &number) != 1) {
                number = 0;
            }
            std::fclose(file);
        }
    }
    return static_cast<Mistake>(number);
}
