//! Evidence with something changed at random: refused or still true, never a panic.

use lapjury::property::Evidence;
use lapjury::property::recheck::from_excerpt;
use proptest::prelude::*;
use serde_json::Value;

/// The paths of all leaves that are numbers, and of all lists.
fn paths(value: &Value, at: &str, numbers: &mut Vec<String>, lists: &mut Vec<String>) {
    match value {
        Value::Number(_) => numbers.push(at.into()),
        Value::Array(items) => {
            lists.push(at.into());
            items.iter().enumerate().for_each(|(k, v)| paths(v, &format!("{at}/{k}"), numbers, lists));
        }
        Value::Object(map) => map.iter().for_each(|(k, v)| paths(v, &format!("{at}/{k}"), numbers, lists)),
        _ => {}
    }
}

fn changed_number(number: &Value, how: u8) -> Value {
    if let Some(n) = number.as_u64() {
        let n = match how % 6 {
            0 => n.wrapping_add(1),
            1 => n.wrapping_sub(1),
            2 => n.wrapping_mul(2).wrapping_add(3),
            3 => 0,
            4 => u64::MAX,
            _ => 1 << 40,
        };
        return n.into();
    }
    let x = number.as_f64().unwrap();
    let changed = [x.next_up(), -x, 2.0 * x, 0.0, 1e300, -1e-300, x + 1e-9, 1.0];
    changed[usize::from(how) % changed.len()].into()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_changed_number_is_refused_or_true_and_never_a_panic(
        which in any::<prop::sample::Index>(), place in any::<prop::sample::Index>(), how in any::<u8>()
    ) {
        thread_local!(static ALL: Vec<crate::Example> = crate::all());
        ALL.with(|all| {
            let example = &all[which.index(all.len())];
            let original = serde_json::to_value(&example.evidence).unwrap();
            let (mut numbers, mut lists) = (Vec::new(), Vec::new());
            paths(&original, "", &mut numbers, &mut lists);
            if numbers.is_empty() {
                return Ok(());
            }
            let path = &numbers[place.index(numbers.len())];
            let mut value = original.clone();
            let leaf = value.pointer_mut(path).unwrap();
            *leaf = changed_number(leaf, how);
            let Ok(evidence) = serde_json::from_value::<Evidence>(value) else { return Ok(()) };
            let _ = from_excerpt(&evidence);
            let answer = example.against(&evidence);
            // Whatever was copied wrongly is seen.
            let differs = evidence.excerpt != example.evidence.excerpt;
            prop_assert!(!differs || answer.is_err(), "{} {path}: {answer:?}", example.name);
            Ok(())
        })?;
    }

    #[test]
    fn a_list_cut_short_or_turned_round_is_never_a_panic(
        which in any::<prop::sample::Index>(), place in any::<prop::sample::Index>(), how in any::<u8>()
    ) {
        thread_local!(static ALL: Vec<crate::Example> = crate::all());
        ALL.with(|all| {
            let example = &all[which.index(all.len())];
            let original = serde_json::to_value(&example.evidence).unwrap();
            let (mut numbers, mut lists) = (Vec::new(), Vec::new());
            paths(&original, "", &mut numbers, &mut lists);
            if lists.is_empty() {
                return;
            }
            let mut value = original.clone();
            let list = value.pointer_mut(&lists[place.index(lists.len())]).unwrap().as_array_mut().unwrap();
            match how % 4 {
                0 => drop(list.pop()),
                1 => list.clear(),
                2 => list.reverse(),
                _ => list.extend(list.clone()),
            }
            if let Ok(evidence) = serde_json::from_value::<Evidence>(value) {
                let _ = from_excerpt(&evidence);
                let _ = example.against(&evidence);
            }
        });
    }
}

#[test]
fn a_number_that_json_does_not_have_does_not_parse() {
    for text in [
        r#"{"statement":{"kind":"row-sum","i":0,"threshold":NaN}}"#,
        r#"{"statement":{"kind":"row-sum","i":0,"threshold":1e999}}"#,
        r#"{"statement":{"kind":"row-sum","i":-1,"threshold":0.0}}"#,
        r#"{"statement":{"kind":"row-sum","i":0,"threshold":null}}"#,
        r#"{"statement":{"kind":"row-sum","i":0,"threshold":0.0,"more":1}}"#,
    ] {
        assert!(serde_json::from_str::<Evidence>(text).is_err(), "{text}");
    }
}
