/* The tests on the host. */
#include "epas_test.h"

#include <stdio.h>

/* Of the README's example of a screw without cage, too large for the memory of a small board beside all tests. */
void screw_init(void);
float screw_step(float nut_speed, float axial_load);

void test_put(const char *text)
{
    (void)fputs(text, stdout);
}

void test_put_number(uint32_t number)
{
    (void)printf("%lu", (unsigned long)number);
}

int main(void)
{
    uint32_t wrong = test_cases() + test_refusals() + test_changes() + test_reaction();

    screw_init();
    if (!((screw_step(40.0f, 3000.0f) > 0.0f) && (screw_step(-40.0f, 3000.0f) < 0.0f))) {
        test_put("the example of a screw without cage has no friction\n");
        wrong++;
    }
    return (wrong == 0u) ? 0 : 1;
}
