#!/bin/sh
# What networks of the recipe lose beside what was measured in N-body runs by other people, one row a run: ./runs.sh [HOW MANY]
#
# Shape, spin and relaxation time are those of the run, from data/published/quillen_2019; all else is that of model.toml. No parameter is
# adjusted. The power is that of the average at the start of `quasirigid evolve`, which reads each model from its standard input. The average
# takes the body as stiff; the last column is the error that `evolve` tells for that.
cd "$(dirname "$0")" || exit 2
echo "| run | b/a | c/a | spin | measured | network | ratio | average off by |"
echo "|---|---|---|---|---|---|---|---|"
awk -F, '$13 == 1' ../../data/published/quillen_2019/runs.csv | head -n "${1:-42}" |
    while IFS=, read -r run b c x y z _ _ time measured _; do
        axes=$(awk -v b="$b" -v c="$c" 'BEGIN { a = exp(-log(b * c) / 3); printf "[%.9f, %.9f, %.9f]", a, a * b, a * c }')
        sed -e "s/^semi_axes = .*/semi_axes = $axes/" -e "s/time = [0-9.e-]*/time = $time/" \
            -e "s/^angular_velocity = .*/angular_velocity = [$x, $y, $z]/" model.toml |
            quasirigid evolve - --method average --power harmonics --json --quiet 2> /dev/null |
            awk -v row="| $run | $b | $c | ($x, $y, $z)" -v measured="$measured" '
                { gsub(/[",]/, "") }
                $1 == "power:" { power = $2 }
                $1 == "time_error:" { error = $2 == "null" ? "not known" : sprintf("%.1f %%", 100 * $2) }
                END { printf "%s | %.3e | %.3e | %.2f | %s |\n", row, -measured, power, -measured / power, error }'
    done
