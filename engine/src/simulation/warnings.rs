//! What of a run was approximated or cut short, in sentences for the user.

use super::state::State;
use super::targets::Target;
use crate::blast::Extension;

/// One sentence a charge about bodies outside the range of its curves.
pub(super) fn reach(targets: &[Target], charges: usize) -> Vec<String> {
    let mut warnings = Vec::new();
    for charge in 0..charges {
        let count = |extension| targets.iter().filter(|t| t.reach[charge] == extension).count();
        let near = count(Extension::Near);
        if near > 0 {
            warnings.push(format!(
                "{near} of {} bodies are nearer to charge {charge} than its curves reach: the curves' innermost \
                 values are held",
                targets.len()
            ));
        }
        let far = count(Extension::Far);
        if far > 0 {
            warnings.push(format!(
                "{far} of {} bodies are farther from charge {charge} than its curves reach: the decay of a weak \
                 shock continues them",
                targets.len()
            ));
        }
    }
    warnings
}

/// Of bodies that stand on nothing.
pub(super) fn hanging(count: usize) -> Option<String> {
    (count > 0)
        .then(|| format!("{count} bodies stand on nothing: they are held in place until a blast moves them"))
}

/// Of bodies that still move at the end of a run that was to last until all rest.
pub(super) fn moving(state: &State, now: f64) -> Option<String> {
    let moving = state.lives.iter().filter(|life| life.facts.rest_time.is_nan()).count();
    (moving > 0).then(|| {
        format!(
            "{moving} of {} bodies still move at {now:.2} s, where the run ends at the latest",
            state.len()
        )
    })
}

/// Of bodies that are too far from the others, or too large, to meet more than the ground. `reach` [m] is how far is too
/// far.
pub(super) fn far(count: usize, of: usize, reach: f64) -> Option<String> {
    (count > 0).then(|| {
        format!(
            "{count} of {of} bodies are more than {} km from the middle of the scene or too large: they meet only the \
             ground",
            reach / 1e3
        )
    })
}
