1// A choice by number; `case 2` goes on with what follows.
float cases(float x, float y) {
    float sum = 0.0;
    for (int i = 0; i < 6; i++) {
        switch (i) {
            case 0:
            case 4: sum += x; break;
            case 1:
                if (x < y) break;
                sum += 2.0 * y;
                break;
            case 3: continue;
            case 2: sum += 0.0;
            default: sum *= 1.25;
        }
        sum += 0.125;
    }
    return sum;
}
