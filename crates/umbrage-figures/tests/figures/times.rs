//! R87-T1, whose table is of seconds.

use umbrage_figures::{Context, catalogue};

#[test]
fn r87_t1_the_parts_of_the_time_are_the_whole_of_it_and_none_is_negative() {
    let figure = catalogue::choose(&["R87-T1".to_string()]).unwrap()[0];
    let made = (figure.make)(&Context { quick: true, ..Context::default() }).unwrap();
    let table = &made.run_tables[0];
    let columns: Vec<usize> = ["of the total: pass 1, %", "look-ups, %", "the picture itself, %"]
        .map(|name| table.head.iter().position(|head| head == name).expect(name))
        .to_vec();
    assert!(!table.rows.is_empty());
    for row in &table.rows {
        let parts: Vec<f64> = columns.iter().map(|column| row[*column].parse().unwrap()).collect();
        assert!(parts.iter().all(|part| *part >= 0.0), "{row:?}");
        // Each part is rounded to a tenth.
        assert!((parts.iter().sum::<f64>() - 100.0).abs() < 0.16, "{row:?}");
    }
}
